//! The page in a real browser: a figure is there, the slider moves it, solutions can be picked, there is
//! nothing on the console. Where there is no Chromium the browser's tests say so and pass.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command as Process;

fn krawl(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

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
    let output = Process::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--enable-logging=stderr",
            "--virtual-time-budget=20000",
            "--dump-dom",
        ])
        .arg(format!("--window-size={size}"))
        .arg(format!(
            "--user-data-dir={}",
            folder.path().join("profile").display()
        ))
        .arg(format!("file://{}", driven.display()))
        .output()
        .unwrap();
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let title = dom
        .split_once("<title>")
        .and_then(|(_, rest)| rest.split_once("</title>"))
        .map_or(String::new(), |(title, _)| title.to_owned());
    let errors = String::from_utf8_lossy(&output.stderr);
    // The test reads pixels often, which the page does not.
    let console = errors
        .lines()
        .filter(|line| line.contains("CONSOLE") && !line.contains("willReadFrequently"));
    (title, console.collect::<Vec<_>>().join("\n"))
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
    // Every pick, with all figures shown at once, and every place of the slider, drawn: milliseconds each.
    let script = "
        key('a'); await frames(2);
        const slider = $('slider'), clock = performance.now();
        let n = 0;
        for (const li of [...$('list').children].slice(0, 60)) { li.click(); await new Promise((r) => setTimeout(r, 0)); n++; }
        said.push(n, $('list').children.length, ink('view'));";
    let (title, console) = driven(&browser, &page, script, "1200,900");
    assert_eq!(console, "");
    let said = said(&title);
    assert_eq!((&said[0], &said[1]), (&60.into(), &285.into()), "{title}");
    assert!(said[2][0].as_u64().unwrap() > 10_000);
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
