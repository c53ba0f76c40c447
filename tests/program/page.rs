//! The page in a real browser: a figure is there, the slider moves it, solutions can be picked, there is
//! nothing on the console. Where there is no Chromium the browser's tests say so and pass.

use crate::krawl;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command as Process;

/// The browser, if there is one.
fn browser() -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let found = std::env::split_paths(&folders)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|path| path.is_file());
    if found.is_none() {
        eprintln!("skipped: there is no Chromium on the PATH");
    }
    found
}

/// What a script at the end of the page leaves as the document's title, and what the console had.
fn driven(browser: &Path, page: &Path, script: &str, size: &str) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    let html = fs::read_to_string(page).unwrap();
    let script = format!(
        "<script>\
         window.failures = [];\
         addEventListener('error', (e) => failures.push(e.message));\
         const ink = (id) => {{\
           const c = document.getElementById(id), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;\
           let n = 0, h = 0;\
           for (let i = 3; i < d.length; i += 4) if (d[i]) {{ n++; h = (h * 31 + i + d[i - 1] + 7 * d[i - 3]) % 1000003; }}\
           return [n, h];\
         }};\
         const frames = async (n) => {{ for (let i = 0; i < n; i++) await new Promise((r) => setTimeout(r, 30)); }};\
         const key = (k) => document.dispatchEvent(new KeyboardEvent('keydown', {{ key: k, bubbles: true }}));\
         const $ = (id) => document.getElementById(id);\
         (async () => {{ await frames(6); const said = []; try {{ {script} }} catch (e) {{ said.push('failed: ' + e.message); }}\
           document.title = JSON.stringify({{ said, failures }}); }})();\
         </script></body>"
    );
    let driven = folder.path().join("driven.html");
    // In virtual time there are no frames: a timer stands in for them.
    let frames = "<head><script>requestAnimationFrame = (f) => setTimeout(() => f(performance.now()), 16);</script>";
    let html = html.replacen("<head>", frames, 1);
    fs::write(&driven, html.replace("</body>", &script)).unwrap();
    let output = headless(browser, folder.path(), size)
        .args(["--virtual-time-budget=20000", "--dump-dom"])
        .arg(format!("file://{}", driven.display()))
        .output()
        .unwrap();
    let title = title(&String::from_utf8_lossy(&output.stdout));
    let errors = String::from_utf8_lossy(&output.stderr);
    // The test reads pixels often, which the page does not.
    let console = errors
        .lines()
        .filter(|line| line.contains("CONSOLE") && !line.contains("willReadFrequently"));
    (title, console.collect::<Vec<_>>().join("\n"))
}

/// The median time of a frame in milliseconds for what people do, by the browser's own clock: the script draws every frame
/// at once and reads a pixel of it, so that it is drawn when the clock is read.
fn timed(browser: &Path, page: &Path) -> serde_json::Value {
    let folder = tempfile::tempdir().unwrap();
    let html = fs::read_to_string(page).unwrap();
    let frames = "<head><script>window.waiting = []; requestAnimationFrame = (f) => waiting.push(f);</script>";
    let script = "<script>addEventListener('load', () => {\
        const $ = (id) => document.getElementById(id), said = {};\
        const frame = () => { const all = waiting; waiting = []; all.forEach((f) => f(performance.now()));\
          for (const id of ['view', 'chart']) $(id).getContext('2d').getImageData(0, 0, 1, 1); };\
        const timed = (name, n, f) => { const all = [];\
          for (let i = 0; i < n; i++) { const from = performance.now(); f(i); frame(); all.push(performance.now() - from); }\
          said[name] = all.sort((a, b) => a - b)[n >> 1]; };\
        const view = $('view'); let x = 300; view.setPointerCapture = () => {};\
        const point = (type) => view.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: x, clientY: 300, buttons: 1 }));\
        const move = (i) => { $('slider').value = $('slider').max * ((i * 37) % 100) / 100; $('slider').dispatchEvent(new Event('input')); };\
        frame(); frame(); point('pointerdown');\
        timed('slider', 60, move); timed('turn', 40, () => { x += 5; point('pointermove'); });\
        timed('pick', 40, (i) => $('list').children[1 + 5 * i].click());\
        document.dispatchEvent(new KeyboardEvent('keydown', { key: 'a' })); frame();\
        timed('slider with all', 60, move); timed('turn with all', 40, () => { x += 5; point('pointermove'); });\
        document.title = JSON.stringify({ said, failures: [] }); });</script></body>";
    let html = html
        .replacen("<head>", frames, 1)
        .replace("</body>", script);
    let driven = folder.path().join("timed.html");
    fs::write(&driven, html).unwrap();
    let output = headless(browser, folder.path(), "1200,900")
        .arg("--dump-dom")
        .arg(format!("file://{}", driven.display()))
        .output()
        .unwrap();
    let title = title(&String::from_utf8_lossy(&output.stdout)).replace("&quot;", "\"");
    let value: serde_json::Value =
        serde_json::from_str(&title).unwrap_or_else(|_| panic!("{title}"));
    value["said"].clone()
}

/// The browser without a window, and a profile of its own.
fn headless(browser: &Path, folder: &Path, size: &str) -> Process {
    let mut process = Process::new(browser);
    process.args([
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--enable-logging=stderr",
    ]);
    process.arg(format!("--window-size={size}"));
    process.arg(format!(
        "--user-data-dir={}",
        folder.join("profile").display()
    ));
    process
}

fn title(dom: &str) -> String {
    dom.split_once("<title>")
        .and_then(|(_, rest)| rest.split_once("</title>"))
        .map_or(String::new(), |(title, _)| title.to_owned())
}

fn said(title: &str) -> Vec<serde_json::Value> {
    let title = title.replace("&quot;", "\"").replace("&amp;", "&");
    let value: serde_json::Value = serde_json::from_str(&title)
        .unwrap_or_else(|_| panic!("the page did not come to the end of the script: {title}"));
    assert_eq!(value["failures"], serde_json::json!([]), "{title}");
    value["said"].as_array().unwrap().clone()
}

#[test]
fn the_page_can_be_used() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    for problem in ["octahedron", "k33"] {
        let page = folder.path().join(format!("{problem}.html"));
        let file = format!("problems/{problem}.toml");
        let (code, out, errors) = krawl(&["solve", &file, "--html", page.to_str().unwrap()]);
        assert_eq!(code, Some(0), "{errors}");
        assert!(out.starts_with(problem), "the table is still printed");
        let script = "
            said.push(ink('view'), ink('chart'));
            const slider = $('slider');
            slider.value = 0.4 * slider.max; slider.dispatchEvent(new Event('input')); await frames(3);
            said.push(ink('view'), $('caption').textContent, $('where').textContent);
            slider.value = 0.6 * slider.max; slider.dispatchEvent(new Event('input')); await frames(3);
            said.push(ink('view'), $('where').textContent);
            $('list').children[2].click(); await frames(3);
            said.push(ink('view'), $('caption').textContent, $('digits').querySelectorAll('td').length);
            key('ArrowDown'); await frames(3);
            said.push($('caption').textContent);
            key('t'); await frames(3);
            said.push(document.documentElement.dataset.theme, ink('view'));
            key('+'); await frames(3);
            said.push(ink('view'));
            $('play').click(); await frames(12); $('play').click();
            said.push($('where').textContent, $('list').children.length);
            $('how-near').open = true; await frames(3);
            said.push(ink('accuracy'));";
        for size in ["1200,900", "380,700"] {
            let (title, console) = driven(&browser, &page, script, size);
            assert_eq!(console, "", "{problem} {size}");
            let said = said(&title);
            assert_eq!(said.len(), 17, "{title}");
            let pixels = |k: usize| said[k][0].as_u64().unwrap();
            let text = |k: usize| said[k].as_str().unwrap();
            // A figure is there, and a curve.
            assert!(pixels(0) > 1000 && pixels(1) > 800, "{title}");
            // The slider moves the figure.
            assert_ne!(said[2], said[5], "{title}");
            assert!(text(3).starts_with("On the path, t = ") && text(4).starts_with("t = "));
            assert_ne!(said[4], said[6]);
            // A solution is picked, and the next by key.
            assert!(text(8).starts_with("Solution 2"), "{title}");
            assert!(said[9].as_u64().unwrap() > 10, "its coordinates are there");
            assert!(text(10).starts_with("Solution 3"));
            // Dark, and larger.
            assert!(["dark", "light"].contains(&text(11)));
            assert_ne!(said[12], said[13]);
            // The picture of the accuracy.
            assert!(pixels(16) > 300, "{title}");
        }
    }
}

#[test]
fn a_result_is_shown_and_many_solutions_are_smooth() {
    let folder = tempfile::tempdir().unwrap();
    let json = folder.path().join("icosahedron.json");
    let (code, _, errors) = krawl(&[
        "solve",
        "problems/icosahedron.toml",
        "--json",
        json.to_str().unwrap(),
        "--samples",
        "2000",
        "--quiet",
    ]);
    assert_eq!(code, Some(0), "{errors}");
    let (code, out, errors) = krawl(&["show", json.to_str().unwrap()]);
    assert_eq!(code, Some(0), "{errors}");
    let page = folder.path().join("icosahedron.html");
    assert_eq!(out.trim(), page.to_str().unwrap());
    assert!(fs::metadata(&page).unwrap().len() < 4_000_000);
    let Some(browser) = browser() else { return };
    let script = "
        key('a'); await frames(2);
        for (const li of [...$('list').children].slice(0, 60)) { li.click(); await frames(0); }
        await frames(2);
        said.push($('list').children.length, ink('view'));";
    let (title, console) = driven(&browser, &page, script, "1200,900");
    assert_eq!(console, "");
    let said = said(&title);
    assert_eq!(said[0], 285, "{title}");
    assert!(said[1][0].as_u64().unwrap() > 10_000);
    // Figures of these times are in docs/measured/figures.md.
    let times = timed(&browser, &page);
    eprintln!("milliseconds for a frame: {times}");
    for what in ["slider", "turn", "pick", "slider with all", "turn with all"] {
        assert!(times[what].as_f64().unwrap() > 0.0, "{what}: {times}");
    }
}

#[test]
fn pictures_and_figures_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (code, _, errors) = krawl(&[
        "solve",
        "problems/octahedron.toml",
        "--svg",
        &path("a.svg"),
        "--animation",
        &path("b.svg"),
        "--obj",
        &path("c.obj"),
        "--xyz",
        &path("d.xyz"),
        "--quiet",
    ]);
    assert_eq!(code, Some(0), "{errors}");
    let read = |name: &str| fs::read_to_string(path(name)).unwrap();
    // Well-formed, with a line for each bar of the sketch and of four solutions.
    let (svg, moving) = (read("a.svg"), read("b.svg"));
    let document = roxmltree::Document::parse(&svg).unwrap();
    let lines = document.descendants().filter(|n| n.has_tag_name("path"));
    assert_eq!(lines.count(), 5 * 12);
    let document = roxmltree::Document::parse(&moving).unwrap();
    let animations: Vec<_> = document
        .descendants()
        .filter(|n| n.has_tag_name("animate"))
        .collect();
    // Twelve bars, six points and the dot on the curve, the latter in two coordinates each.
    assert_eq!(animations.len(), 12 + 2 * 6 + 2);
    let count = |n: &roxmltree::Node, key: &str| n.attribute(key).unwrap().split(';').count();
    for n in &animations {
        assert_eq!(count(n, "values"), count(n, "keyTimes"));
        let times: Vec<f64> = n
            .attribute("keyTimes")
            .unwrap()
            .split(';')
            .map(|t| t.parse().unwrap())
            .collect();
        assert!(times.is_sorted() && times[0] == 0.0 && times[times.len() - 1] == 1.0);
    }
    // The solutions meet the dimensions in OBJ, and XYZ has as many points.
    let obj = read("c.obj");
    let vertices: Vec<Vec<f64>> = obj
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .map(|line| line.split(' ').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(vertices.len(), 5 * 6);
    assert_eq!(
        obj.lines().filter(|line| line.starts_with("l ")).count(),
        5 * 12
    );
    for k in 1..5 {
        let (a, b) = (&vertices[6 * k], &vertices[6 * k + 1]);
        let distance = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        assert!((distance - 1.12).abs() < 1e-12, "{distance}");
    }
    let xyz = read("d.xyz");
    assert_eq!(xyz.lines().count(), 4 * 8);
    assert!(xyz.starts_with("6\noctahedron: Solution 1, reached without a fold\n"));
}

/// Lines, a circle and an arc in DXF, read back as groups of a code and a value, against what was asked for.
#[test]
fn figures_are_written_as_dxf() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let text = "name = \"bracket\"\ndimension = 2\n[points]\na = [0, 0]\nb = [40, 1]\nc = [39, 20]\no = [30, 10]\n\
                [lines]\nl = [\"a\", \"b\"]\n[circles]\nk = { center = \"o\", radius = 4 }\n\
                [arcs]\nr = { center = \"a\", start = \"b\", end = \"c\" }\n[constraints]\nfixed = [\"a\"]\nhorizontal = [\"l\"]\n\
                x = [[\"o\", 30]]\ny = [[\"o\", 10]]\ndistances = [[\"a\", \"b\", 40]]\nradii = [[\"k\", 4]]\n\
                angles = [[\"b\", \"a\", \"c\", 30]]\n";
    fs::write(path("bracket.toml"), text).unwrap();
    let (code, _, errors) = krawl(&[
        "edit",
        &path("bracket.toml"),
        "--set",
        "radii:k=5",
        "--dxf",
        &path("after.dxf"),
        "--quiet",
    ]);
    assert_eq!(code, Some(0), "{errors}");
    let dxf = fs::read_to_string(path("after.dxf")).unwrap();
    let lines: Vec<&str> = dxf.lines().collect();
    let groups: Vec<(u32, &str)> = lines
        .chunks(2)
        .map(|pair| (pair[0].parse().unwrap(), pair[1]))
        .collect();
    assert_eq!(groups.last(), Some(&(0, "EOF")));
    let entity = |kind: &str| -> Vec<(u32, f64)> {
        let begin = groups.iter().position(|&group| group == (0, kind)).unwrap();
        let own = groups[begin + 1..].iter().take_while(|group| group.0 != 0);
        let own = own.filter(|group| group.0 != 8);
        own.map(|&(code, value)| (code, value.parse().unwrap()))
            .collect()
    };
    let expected: [(&str, &[(u32, f64)]); 3] = [
        (
            "LINE",
            &[
                (10, 0.0),
                (20, 0.0),
                (30, 0.0),
                (11, 40.0),
                (21, 0.0),
                (31, 0.0),
            ],
        ),
        ("CIRCLE", &[(10, 30.0), (20, 10.0), (30, 0.0), (40, 5.0)]),
        (
            "ARC",
            &[
                (10, 0.0),
                (20, 0.0),
                (30, 0.0),
                (40, 40.0),
                (50, 0.0),
                (51, 30.0),
            ],
        ),
    ];
    for (kind, expected) in expected {
        let found = entity(kind);
        assert_eq!(found.len(), expected.len(), "{kind}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert_eq!(found.0, expected.0, "{kind}");
            assert!((found.1 - expected.1).abs() < 1e-9, "{kind}: {found:?}");
        }
    }
    // Sets have circles in them, too.
    let text = text.replace("angles", "fixed = [\"o\"]\nangles");
    let text = text
        .replace("fixed = [\"a\"]\n", "")
        .replace("x = [[\"o\", 30]]\ny = [[\"o\", 10]]\n", "");
    let text = text.replace("fixed = [\"o\"]", "fixed = [\"o\", \"a\"]");
    fs::write(path("set.toml"), text).unwrap();
    let (code, _, errors) = krawl(&[
        "all",
        &path("set.toml"),
        "--dxf",
        &path("set.dxf"),
        "--quiet",
    ]);
    assert_eq!(code, Some(0), "{errors}");
    assert!(
        fs::read_to_string(path("set.dxf"))
            .unwrap()
            .contains("\nCIRCLE\n")
    );
    // A figure of bars alone has these.
    let (code, _, errors) = krawl(&[
        "solve",
        "problems/octahedron.toml",
        "--dxf",
        &path("bars.dxf"),
        "--quiet",
    ]);
    assert_eq!(code, Some(0), "{errors}");
    let dxf = fs::read_to_string(path("bars.dxf")).unwrap();
    assert_eq!(dxf.matches("\nLINE\n").count(), 4 * 12);
}

#[test]
fn edits_and_complete_sets_have_pages_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (page, svg) = (path("edit.html"), path("all.svg"));
    let plate = "docs/examples/plate.toml";
    let (code, _, errors) = krawl(&["edit", plate, "--set", "C-D=40", "--html", &page]);
    assert_eq!(code, Some(0), "{errors}");
    let (code, _, errors) = krawl(&[
        "all",
        "docs/examples/platform.toml",
        "--html",
        &path("all.html"),
        "--svg",
        &svg,
    ]);
    assert_eq!(code, Some(0), "{errors}");
    let bar = "problems/mechanisms/four-bar.toml";
    let limits = path("limits.html");
    let (code, _, errors) = krawl(&["limits", bar, "--html", &limits]);
    assert_eq!(code, Some(0), "{errors}");
    let (code, _, errors) = krawl(&["limits", bar, "--html", bar]);
    assert!(
        code == Some(2) && errors.contains("is read; name another file"),
        "{errors}"
    );
    let svg = fs::read_to_string(svg).unwrap();
    assert!(svg.contains("Solution 4") && !svg.contains("Solution 5"));
    let Some(browser) = browser() else { return };
    let script = "said.push($('list').children.length, $('caption').textContent, ink('view'), $('travel').hidden);";
    for (name, figures, first) in [
        ("edit.html", 2, "After"),
        ("all.html", 5, "Solution 1"),
        // B-D is driven, and has its limits; other dimensions have one or two.
        ("limits.html", 0, ""),
    ] {
        let (title, console) = driven(&browser, &folder.path().join(name), script, "1200,900");
        assert_eq!(console, "", "{name}");
        let said = said(&title);
        match figures {
            0 => assert!(said[0].as_u64().unwrap() > 4, "{title}"),
            _ => assert_eq!(said[0], figures),
        }
        assert!(said[1].as_str().unwrap().starts_with(first), "{title}");
        assert!(said[2][0].as_u64().unwrap() > 1000 && said[3] == true);
    }
}

/// What a page claims names what was held, and how far a motion was followed.
#[test]
fn pages_say_of_what_their_claims_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (file, page) = (path("quad.toml"), path("page.html"));
    let text = "name = \"quad\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [5, 2]\nd = [2, 5]\n[constraints]\n\
                distances = [[\"a\", \"b\", 4], [\"b\", \"c\", 2], [\"c\", \"d\", 4.3], [\"a\", \"d\", 5.3]]\n";
    fs::write(&file, text).unwrap();
    let told = |arguments: &[&str]| {
        krawl(&[arguments, &["--html", &page]].concat());
        fs::read_to_string(&page).unwrap()
    };
    let html = told(&["limits", &file]);
    for words in [
        "coordinates were held",
        " held on all of the way or a part of it",
        "However the rest moves, a-d is at most 10.3",
        "can go at least so far",
    ] {
        assert!(html.contains(words), "{words}");
    }
    assert!(
        !html.contains("that it can be<")
            && !html.contains("exactly one figure for every value, and")
    );
    let html = told(&["edit", &file, "--set", "a-d=0.05"]);
    assert!(
        html.contains("beyond it there is none so")
            || html.contains("that continues the old one, with")
            || html.contains("that continues the old one in")
    );
    let bar = "problems/mechanisms/four-bar.toml";
    let html = told(&["motion", bar, "--free", "B-D"]);
    assert!(html.contains("Between which bounds it stays, proved:"));
}

/// A rectangle with one diagonal, which is followed block by block, and a store's folder beside it.
fn rectangle(folder: &Path) -> String {
    let file = folder.join("rectangle.toml");
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [0, 3]\n[constraints]\n\
                distances = [[\"a\", \"b\", 5], [\"b\", \"c\", 3], [\"c\", \"d\", 5], [\"d\", \"a\", 3]]\n\
                squared_distances = [[\"a\", \"c\", 34]]\n";
    fs::write(&file, text).unwrap();
    file.to_str().unwrap().to_owned()
}

#[test]
fn a_result_is_shown_as_the_verb_itself_shows_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (plate, bar) = (
        "docs/examples/plate.toml",
        "problems/mechanisms/four-bar.toml",
    );
    let (rectangle, store) = (rectangle(folder.path()), path("store"));
    let runs: [(&str, &[&str]); 9] = [
        ("solve", &["solve", "problems/k33.toml", "--samples", "90"]),
        ("float", &["solve", "problems/k33.toml", "--mode", "float"]),
        ("blocks", &["solve", &rectangle]),
        ("edit", &["edit", plate, "--set", "C-D=40"]),
        ("edit-limit", &["edit", plate, "--set", "C-D=30"]),
        (
            "sweep",
            &[
                "sweep", bar, "--vary", "B-D", "--from", "5", "--to", "50", "--frames", "20",
            ],
        ),
        ("limits", &["limits", bar]),
        ("all", &["all", "problems/prism.toml"]),
        (
            "explore",
            &[
                "explore",
                "problems/icosahedron-c1.toml",
                "--store",
                &store,
                "--paths",
                "3",
                "--all-time",
                "0",
            ],
        ),
    ];
    for (name, arguments) in runs {
        let [json, page, shown] =
            ["json", "html", "shown.html"].map(|e| path(&format!("{name}.{e}")));
        let own = [arguments, &["--json", &json, "--html", &page, "--quiet"]].concat();
        let (code, _, errors) = krawl(&own);
        assert!(matches!(code, Some(0 | 3 | 4)), "{name}: {errors}");
        let (code, _, errors) = krawl(&["show", &json, "--html", &shown]);
        assert_eq!(code, Some(0), "{name}: {errors}");
        let [page, shown] = [page, shown].map(|file| fs::read_to_string(file).unwrap());
        assert!(page == shown, "{name}: the pages differ");
        assert!(page.contains("\"figures\":[{"), "{name}");
    }
    let Some(browser) = browser() else { return };
    // Solutions that were found on different paths: each comes with its own.
    let script = "
        const items = [...$('list').children];
        for (const li of [items[1], items[items.length - 1]]) {
          li.click(); await frames(3);
          said.push($('caption').textContent, $('which').textContent, $('where').textContent, ink('chart'), ink('view'));
          $('slider').value = 0.5 * $('slider').max; $('slider').dispatchEvent(new Event('input')); await frames(3);
          said.push(ink('view'));
        }
        items[0].click(); await frames(3);
        said.push($('travel').hidden);";
    let (title, console) = driven(
        &browser,
        &folder.path().join("explore.html"),
        script,
        "1200,900",
    );
    assert_eq!(console, "");
    let found = said(&title);
    assert!(
        found[0]
            .as_str()
            .unwrap()
            .contains("on path 0, from the drawn sketch"),
        "{title}"
    );
    assert!(found[1].as_str().unwrap().starts_with("path 0"), "{title}");
    assert!(found[6].as_str().unwrap().contains(", branch "), "{title}");
    assert_ne!(found[1], found[7], "another path");
    for k in [2, 8] {
        assert_eq!(found[k], "t = 1.0000", "{title}");
    }
    for k in [3, 9] {
        assert!(found[k][0].as_u64().unwrap() > 800, "its curve: {title}");
        assert_ne!(
            found[k + 1],
            found[k + 2],
            "the slider moves the figure: {title}"
        );
    }
    assert_ne!(found[3], found[9], "{title}");
    assert_eq!(found[12], true, "the sketch of the page is on no path");
    // Figures of the whole, made of those of blocks.
    let script = "said.push($('list').children.length, $('caption').textContent, ink('view'), $('travel').hidden, \
                  $('verdict').textContent);";
    let (title, console) = driven(
        &browser,
        &folder.path().join("blocks.html"),
        script,
        "1200,900",
    );
    assert_eq!(console, "");
    let found = said(&title);
    assert_eq!(found[0], 3, "{title}");
    assert!(
        found[1]
            .as_str()
            .unwrap()
            .contains("Figure 1block 1 solution 1"),
        "{title}"
    );
    assert!(
        found[2][0].as_u64().unwrap() > 1000 && found[3] == true,
        "{title}"
    );
    assert!(
        found[4]
            .as_str()
            .unwrap()
            .starts_with("Combined, proved: 2 figures"),
        "{title}"
    );
}

#[test]
fn results_without_figures_say_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let runs: [(&str, &[&str]); 2] = [
        (
            "complex",
            &[
                "complex",
                "problems/octahedron.toml",
                "--template",
                "problems/octahedron.krawl-template",
            ],
        ),
        (
            "compare",
            &["compare", "problems/k33.toml", "--repeat", "1"],
        ),
    ];
    for (name, arguments) in runs {
        let json = path(&format!("{name}.json"));
        krawl(&[arguments, &["--json", &json, "--quiet"]].concat());
        let (code, _, errors) = krawl(&["show", &json]);
        assert_eq!(code, Some(2), "{name}");
        let words = format!("is a result of `krawl {name}`, which has no figure to draw");
        assert!(errors.contains(&words), "{errors}");
    }
}

#[test]
fn what_is_no_result_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bad.json");
    let page = folder.path().join("page.html");
    for (text, words) in [
        ("", "is not JSON"),
        ("{}", "`version` is missing"),
        ("{\"version\": 7}", "version 7"),
        (
            "{\"version\": 1, \"dimension\": 2, \"names\": [\"a\"]}",
            "is missing or not what it should be",
        ),
        ("{\"version\": 1}\n{\"version\": 1}", "holds 2 results"),
    ] {
        fs::write(&file, text).unwrap();
        let (code, _, errors) = krawl(&[
            "show",
            file.to_str().unwrap(),
            "--html",
            page.to_str().unwrap(),
        ]);
        assert_eq!(code, Some(2), "{text}");
        assert!(errors.contains(words), "{errors}");
        assert!(!page.exists());
    }
    // A float run has no path to travel, and says so where it is asked for one.
    let svg = folder.path().join("a.svg");
    let (code, _, errors) = krawl(&[
        "solve",
        "problems/k33.toml",
        "--mode",
        "float",
        "--quiet",
        "--animation",
        svg.to_str().unwrap(),
    ]);
    assert_eq!(code, Some(2));
    assert!(errors.contains("has no path"), "{errors}");
    let (code, _, _) = krawl(&[
        "solve",
        "problems/k33.toml",
        "--mode",
        "float",
        "--quiet",
        "--html",
        page.to_str().unwrap(),
    ]);
    assert_eq!(code, Some(0));
    assert!(page.exists());
}
