fn main() {
    let mut args = std::env::args().skip(1);
    let threads: usize = args.next().unwrap().parse().unwrap();
    for path in args {
        let p = krawl::problem::Problem::read(&path).unwrap();
        let options = krawl::complete::Options { threads, ..Default::default() };
        match krawl::complete::all(&p, &options) {
            Ok(c) => println!("{path}: {:?} {} solutions, k {} boxes {} {:.6}s undecided {:?} reason {:?} plan {:?}", c.status, c.solutions.len(), c.driving, c.boxes, c.seconds, c.undecided, c.reason, c.plan),
            Err(e) => println!("{path}: {e}"),
        }
    }
}
