//! Every result of every shipped problem meets the schema in docs/schema, and the schema refuses others.

use assert_cmd::Command;
use jsonschema::Validator;
use krawl::track::StopKind;
use serde_json::Value;
use std::fs;

fn schema() -> Validator {
    schema_of("result")
}

fn schema_of(kind: &str) -> Validator {
    let text = fs::read_to_string(format!("docs/schema/{kind}.schema.json")).unwrap();
    let schema: Value = serde_json::from_str(&text).unwrap();
    jsonschema::meta::validate(&schema).expect("the schema itself is in order");
    jsonschema::validator_for(&schema).unwrap()
}

fn solve(arguments: &[&str]) -> Vec<Value> {
    let run = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .arg("solve")
        .args(arguments)
        .args(["--json", "-"])
        .output()
        .unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    let documents = text.lines().map(|line| serde_json::from_str(line).unwrap());
    documents.collect()
}

fn complain(validator: &Validator, document: &Value) -> Vec<String> {
    let errors = validator.iter_errors(document);
    errors
        .map(|e| format!("{}: {e}", e.instance_path()))
        .collect()
}

#[test]
fn all_shipped_problems_meet_the_schema() {
    let validator = schema();
    let mut files: Vec<String> = Vec::new();
    for folder in ["problems", "problems/hard"] {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            // Its 284 solutions take a while in a debug build; icosahedron-c1 stands for it.
            if path.extension().is_some_and(|e| e == "toml") && !path.ends_with("icosahedron.toml")
            {
                files.push(path.to_str().unwrap().to_owned());
            }
        }
    }
    assert!(files.len() > 20);
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let ways: [&[&str]; 3] = [
        &["--samples", "40"],
        &["--space", "reduced"],
        &["--mode", "float"],
    ];
    for way in ways {
        let documents = solve(&[&files[..], way].concat());
        assert_eq!(documents.len(), files.len(), "{way:?}");
        for document in &documents {
            let name = document["problem"].as_str().unwrap();
            assert_eq!(complain(&validator, document), [""; 0], "{name} {way:?}");
            // No nulls but where docs/using/programs.md has them.
            assert!(document["length"].is_number() && document["t_range"][0].is_number());
            assert!(document["frame"].is_object(), "{name}");
            let certified = document["mode"] == "certified";
            for solution in document["solutions"].as_array().unwrap() {
                assert_eq!(solution["arc"].is_number(), certified);
                assert!(certified || solution["folds"].is_null());
                assert_eq!(solution["rising"].is_boolean(), certified);
            }
        }
    }
}

/// The JSON that a command line writes, and what its schema has against it.
fn written(kind: &str, arguments: &[&str]) -> (Value, Vec<String>) {
    let run = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(arguments)
        .args(["--json", "-", "--quiet"])
        .output()
        .unwrap();
    let document: Value = serde_json::from_slice(&run.stdout).unwrap();
    let complaints = complain(&schema_of(kind), &document);
    (document, complaints)
}

#[test]
fn results_of_other_verbs_meet_their_schemas() {
    let plate = "docs/examples/plate.toml";
    let bar = "problems/mechanisms/four-bar.toml";
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().to_str().unwrap();
    for (kind, status, arguments) in [
        ("edit", "reached", &["edit", plate, "--set", "C-D=40"][..]),
        ("edit", "limit", &["edit", plate, "--set", "C-D=200"]),
        (
            "tolerance",
            "proved",
            &["tolerance", plate, "--default", "0.1"],
        ),
        (
            "tolerance",
            "complete",
            &["tolerance", plate, "--default", "0.1", "--all"],
        ),
        (
            "motion",
            "closed",
            &[
                "motion",
                bar,
                "--free",
                "B-D",
                "--measure",
                "area A B C",
                "--measure",
                "turn D A B",
            ],
        ),
        (
            "sweep",
            "reached",
            &[
                "sweep", bar, "--vary", "B-D", "--from", "5", "--to", "5.5", "--frames", "4",
            ],
        ),
        (
            "sweep",
            "limit",
            &[
                "sweep", bar, "--vary", "B-D", "--from", "5", "--to", "50", "--frames", "4",
            ],
        ),
        ("complete", "complete", &["all", "problems/prism.toml"]),
        (
            "complete",
            "complete",
            &["all", "tests/data/norbornane.sdf", "--digits", "20"],
        ),
        (
            "complete",
            "complete",
            &[
                "all",
                "tests/data/stereocentres.sdf",
                "--sketch",
                "(R)-bromochlorofluoromethane",
            ],
        ),
        (
            "complete",
            "complete",
            &["all", "problems/constraints/pentahedron.toml"],
        ),
        (
            "figures",
            "complete",
            &["solve", "problems/sketches/bracket.slvs"],
        ),
        (
            "figures",
            "combined",
            &["solve", "problems/sketches/parts.FCStd", "--sketch", "Slot"],
        ),
        (
            "explore",
            "budget",
            &[
                "explore",
                "problems/octahedron.toml",
                "--paths",
                "1",
                "--store",
                store,
            ],
        ),
        (
            "complete",
            "partial",
            &["all", "problems/icosahedron.toml", "--time", "0.2"],
        ),
    ] {
        let (document, complaints) = written(kind, arguments);
        assert_eq!(complaints, [""; 0], "{arguments:?}");
        assert_eq!(document["status"], status, "{arguments:?}");
    }
    // What is left as it is in the file is said beside the claim.
    let kept = "tests/data/freecad/kept.FCStd";
    let claims: [(&str, &str, &[&str]); 4] = [
        ("complete", "verdict", &["all", kept]),
        ("figures", "verdict", &["solve", kept]),
        ("edit", "words", &["edit", kept, "--set", "w=50"]),
        (
            "tolerance",
            "words",
            &["tolerance", kept, "--default", "0.1"],
        ),
    ];
    for (kind, words, arguments) in claims {
        let (document, complaints) = written(kind, arguments);
        assert_eq!(complaints, [""; 0], "{arguments:?}");
        assert_eq!(document["account"]["left_as_is"][0], "e5", "{arguments:?}");
        let words = document[words].as_str().unwrap();
        assert!(words.contains("left as they are because of"), "{words}");
    }
    let octahedron = "problems/octahedron.toml";
    let template = "problems/octahedron.krawl-template";
    let (complex, complaints) = written(
        "complex",
        &[
            "complex",
            octahedron,
            "--template",
            template,
            "--digits",
            "12",
        ],
    );
    assert_eq!(complaints, [""; 0]);
    assert!(complex["solutions"].as_array().unwrap().len() > 1);
    let butterfly = "problems/mechanisms/double-butterfly.toml";
    let bound = ["complex", butterfly, "--float", "--bound", "18"];
    let (mechanism, complaints) = written("complex", &bound);
    assert_eq!(complaints, [""; 0]);
    assert_eq!(mechanism["gauge"], "the coordinates of the file");
    assert_eq!(mechanism["real"].as_array().unwrap().len(), 6);
    let (comparison, complaints) = written(
        "comparison",
        &["compare", "problems/k33.toml", "--repeat", "1"],
    );
    assert_eq!(complaints, [""; 0]);
    assert!(comparison["problems"][0]["rows"].as_array().unwrap().len() > 3);
    let (limits, complaints) = written("limits", &["limits", bar]);
    assert_eq!(complaints, [""; 0]);
    assert!(limits["ranges"].as_object().unwrap().len() > 3);
}

/// "These 8 of 18".
#[test]
fn a_cheap_count_of_all_figures_is_told_and_can_be_turned_off() {
    let validator = schema();
    let disulfide = "problems/disulfide.toml";
    let told = solve(&[disulfide]).remove(0);
    assert_eq!(complain(&validator, &told), [""; 0]);
    assert_eq!(told["of_all"], 18);
    for other in [
        &[disulfide, "--no-count"][..],
        &[disulfide, "--mode", "float"],
        &["problems/dodecagon.toml"],
        &["problems/constraints/3p3l.toml"],
    ] {
        let document = solve(other).remove(0);
        assert!(document.get("of_all").is_none(), "{other:?}");
    }
}

#[test]
fn answers_to_edits_meet_the_schema() {
    let run = Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["edit", "docs/examples/plate.toml", "--serve"])
        .write_stdin(
            "{\"set\": {\"C-D\": 45}, \"id\": 7}\n{\"set\": {\"C-D\": 10}, \"probe\": true}\n",
        )
        .output()
        .unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    let answers: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(answers.len(), 2);
    for answer in &answers {
        assert_eq!(complain(&schema_of("edit"), answer), [""; 0]);
        // Answers are short: what the problem is the asker knows.
        assert!(answer["sketch"].is_null());
    }
    assert_eq!(
        (&answers[0]["committed"], &answers[0]["id"]),
        (&true.into(), &7.into())
    );
    assert_eq!(answers[1]["status"], "limit");
}

/// Figures are gone back to exactly, one by one or by name; what cannot be is said.
#[test]
fn figures_of_a_session_can_be_gone_back_to() {
    for (file, name, values) in [
        ("docs/examples/plate.toml", "C-D", ["45", "42"]),
        ("docs/examples/slider-crank.toml", "turns:O", ["45", "60"]),
        ("problems/mechanisms/four-bar.toml", "B-D", ["5.1", "5.2"]),
    ] {
        let [one, other] = values.map(|value| format!("{{\"set\": {{\"{name}\": {value}}}}}"));
        let lines = [
            "{\"remember\": true}",
            &one,
            "{\"keep\": \"one\"}",
            &other,
            "{\"undo\": true}",
            "{\"undo\": true}",
            "{\"undo\": true}",
            "{\"back\": \"one\"}",
            "{\"back\": \"two\"}",
            "{\"undo\": true, \"keep\": \"two\"}",
            "{\"undo\": true}",
        ];
        let run = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args(["edit", file, "--serve"])
            .write_stdin(lines.join("\n"))
            .output()
            .unwrap();
        let text = String::from_utf8(run.stdout).unwrap();
        let answers = text.lines().map(|line| serde_json::from_str(line).unwrap());
        let answers: Vec<Value> = answers.collect();
        assert_eq!(answers.len(), lines.len(), "{text}");
        let points = |k: usize| &answers[k]["points"];
        for (k, like) in [(4, 2), (5, 0), (7, 2), (10, 0)] {
            assert_eq!(points(k), points(like), "{file}, line {k}");
        }
        assert!(points(1) == points(2) && points(3) != points(2), "{file}");
        let reason = |k: usize| answers[k]["reason"].as_str().unwrap_or_default();
        assert!(reason(6).contains("nothing to undo"), "{text}");
        assert!(
            reason(8).contains("no figure is kept as `two`; kept: one"),
            "{text}"
        );
        assert!(reason(9).contains("in a line of their own"), "{text}");
        assert_eq!(answers[7]["undo"], 1);
    }
}

#[test]
fn what_is_said_of_the_problem_is_the_same_everywhere() {
    let bar = "problems/mechanisms/four-bar.toml";
    let solved = solve(&[bar]).remove(0);
    let others: [(&str, &[&str]); 4] = [
        ("edit", &["edit", bar, "--set", "B-D=5.2"]),
        (
            "sweep",
            &[
                "sweep", bar, "--vary", "B-D", "--from", "5", "--to", "5.1", "--frames", "2",
            ],
        ),
        ("limits", &["limits", bar, "--only", "B-D"]),
        ("complete", &["all", bar]),
    ];
    assert_eq!(solved["verb"], "solve");
    for (kind, arguments) in others {
        let (document, complaints) = written(kind, arguments);
        assert_eq!(complaints, [""; 0], "{kind}");
        assert_eq!(document["verb"], arguments[0]);
        for key in ["krawl", "problem", "names", "sketch", "constraints"] {
            assert_eq!(document[key], solved[key], "{kind} {key}");
        }
    }
    // A dimension's name is the one that changes it.
    let named = solved["constraints"].as_array().unwrap().iter();
    assert!(named.filter(|c| c["name"] == "B-D").count() == 1);
}

#[test]
fn results_made_block_by_block_meet_the_schema() {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let rectangle = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [0, 3]\n[constraints]\n\
                     distances = [[\"a\", \"b\", 5], [\"b\", \"c\", 3], [\"c\", \"d\", 5], [\"d\", \"a\", 3]]\n\
                     squared_distances = [[\"a\", \"c\", 34]]\n";
    std::fs::write(file.path(), rectangle).unwrap();
    let documents = solve(&[&file.path().display().to_string()]);
    assert_eq!(documents[0]["blocks"]["runs"].as_array().unwrap().len(), 2);
    assert_eq!(complain(&schema(), &documents[0]), Vec::<String>::new());
}

/// A triangle of 9, 5 and 3 does not exist; and one whose base stands where it is with a length said twice is solved by blocks.
#[test]
fn dimensions_out_of_reach_meet_the_schema() {
    let folder = tempfile::tempdir().unwrap();
    let points = "name = \"t\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [0, 3]\n[constraints]\n";
    let of = |more: &str, kind: &str, dimension: &str| {
        let file = folder.path().join("t.toml");
        std::fs::write(&file, format!("{points}{more}\n")).unwrap();
        let (document, complaints) = written(kind, &["solve", file.to_str().unwrap()]);
        assert_eq!(complaints, Vec::<String>::new());
        let alone = document["alone"].as_array().unwrap().clone();
        let named = |one: &&Value| one["dimension"] == dimension;
        let value = alone.iter().find(named).unwrap()["value"][0].as_f64();
        assert!(alone.iter().all(|one| one["ending"] == "limit"));
        value.unwrap()
    };
    let whole = of(
        "distances = [[\"a\", \"b\", 9], [\"b\", \"c\", 5], [\"c\", \"a\", 3]]",
        "result",
        "a-b",
    );
    // With sides of 5 and 3 it grows to 8, with 4 and 3 to 7.
    assert!((whole - 8.0).abs() < 1e-9, "{whole}");
    let by_blocks = of(
        "fixed = [\"a\", \"b\"]\ndistances = [[\"a\", \"b\", 4], [\"b\", \"c\", 8], [\"c\", \"a\", 3]]",
        "figures",
        "b-c",
    );
    assert!((by_blocks - 7.0).abs() < 1e-9, "{by_blocks}");
}

#[test]
fn the_schemas_of_other_verbs_refuse_others() {
    let (edit, _) = written(
        "edit",
        &["edit", "docs/examples/plate.toml", "--set", "C-D=40"],
    );
    let (mut all, _) = written("complete", &["all", "problems/octahedron.toml"]);
    for key in ["version", "status", "points", "kept", "t"] {
        let mut without = edit.clone();
        without.as_object_mut().unwrap().remove(key);
        assert!(!schema_of("edit").is_valid(&without), "{key}");
    }
    for kind in ["complete", "sweep", "limits", "complex", "comparison"] {
        assert!(!schema_of(kind).is_valid(&edit), "{kind}");
    }
    // A complete result has no undecided parts.
    all["undecided"] = serde_json::json!([{"reason": "?", "parts": 1, "share": 0.5}]);
    assert!(!schema_of("complete").is_valid(&all));
}

#[test]
fn folds_samples_and_solutions_belong_to_one_path() {
    for file in [
        "problems/octahedron.toml",
        "problems/k33.toml",
        "problems/dodecagon.toml",
    ] {
        for space in ["full", "reduced"] {
            let all = solve(&[file, "--space", space, "--samples", "2000"]);
            let document = &all[0];
            let number = |value: &Value| value.as_f64().unwrap();
            let length = number(&document["length"]);
            let folds = document["folds"].as_array().unwrap();
            let samples = document["samples"].as_array().unwrap();
            assert_eq!(samples.len(), 2000);
            assert!((number(&samples[1999]["at"]) - length).abs() < 1e-6 * length);
            // A loop turns back as often from rising as from falling, and the samples turn where it does.
            assert!(folds.len() >= 2 && folds.len().is_multiple_of(2), "{file}");
            let turns: Vec<usize> = (1..samples.len() - 1)
                .filter(|&k| {
                    let t = |k: usize| number(&samples[k]["t"]);
                    (t(k) - t(k - 1)) * (t(k + 1) - t(k)) < 0.0
                })
                .collect();
            assert_eq!(turns.len(), folds.len(), "{file} {space}");
            for (&k, fold) in turns.iter().zip(folds) {
                let (low, high) = (number(&fold["t"][0]), number(&fold["t"][1]));
                assert!(low <= high && high - low < 1e-3, "{file}: {low} to {high}");
                assert!(
                    (number(&samples[k]["t"]) - low).abs() < 2e-3,
                    "{file} {space}"
                );
                assert!((number(&fold["at"]) - number(&samples[k]["at"])).abs() < 0.01 * length);
            }
            // Rising at the sketch, and the other way after each fold.
            let mut last = 0.0;
            for solution in document["solutions"].as_array().unwrap() {
                let (arc, passed) = (
                    number(&solution["arc"]),
                    solution["folds"].as_u64().unwrap(),
                );
                let before = folds
                    .iter()
                    .filter(|fold| number(&fold["at"]) < arc)
                    .count();
                assert_eq!(passed as usize, before, "{file} {space}");
                assert_eq!(solution["rising"].as_bool().unwrap(), passed % 2 == 0);
                assert!(arc > last && arc < length);
                last = arc;
                // The samples around it are at t = 1, nearly.
                let k = (arc / length * 1999.0).round() as usize;
                let near = samples[k]["points"].as_array().unwrap();
                let sizes = near.iter().map(|place| place.as_array().unwrap().len());
                assert!(sizes.into_iter().all(|size| document["dimension"] == size));
                assert!(
                    (number(&samples[k]["t"]) - 1.0).abs() < 0.05,
                    "{file} {space}"
                );
            }
        }
    }
}

#[test]
fn the_frame_brings_the_sketch_back() {
    // t = 0 at the first sample, where the figure is the sketch.
    for file in ["problems/octahedron.toml", "problems/k33.toml"] {
        let all = solve(&[file, "--samples", "2"]);
        let document = &all[0];
        let vector = |value: &Value| -> Vec<f64> {
            let entries = value.as_array().unwrap().iter();
            entries.map(|x| x.as_f64().unwrap()).collect()
        };
        let origin = vector(&document["frame"]["origin"]);
        let axes: Vec<Vec<f64>> = document["frame"]["axes"]
            .as_array()
            .unwrap()
            .iter()
            .map(vector)
            .collect();
        let sketch = document["sketch"].as_object().unwrap();
        // Names are sorted here; the file has them so too.
        for ((name, place), sample) in sketch
            .iter()
            .zip(document["samples"][0]["points"].as_array().unwrap())
        {
            let (place, sample) = (vector(place), vector(sample));
            for k in 0..place.len() {
                let there = origin[k]
                    + (0..place.len())
                        .map(|a| axes[a][k] * sample[a])
                        .sum::<f64>();
                assert!(
                    (there - place[k]).abs() < 1e-6,
                    "{file} {name}: {there} {}",
                    place[k]
                );
            }
        }
    }
}

#[test]
fn other_documents_are_refused() {
    let validator = schema();
    let good = solve(&["problems/k33.toml", "--samples", "3"]).remove(0);
    assert_eq!(complain(&validator, &good), [""; 0]);
    let changes: [(&str, Value); 6] = [
        ("version", 2.into()),
        ("status", "ajar".into()),
        ("solutions", Value::Null),
        ("t_range", serde_json::json!([null, null])),
        ("mode", 1.into()),
        ("unknown", true.into()),
    ];
    for (key, value) in changes {
        let mut bad = good.clone();
        bad[key] = value;
        assert!(!complain(&validator, &bad).is_empty(), "{key}");
    }
    for key in good.as_object().unwrap().keys() {
        let mut bad = good.clone();
        bad.as_object_mut().unwrap().remove(key);
        let optional = ["source", "samples", "objects", "of_all"].contains(&key.as_str());
        assert_eq!(complain(&validator, &bad).is_empty(), optional, "{key}");
    }
}

/// A problem in its own frame in which nothing moves with t: t goes on without end, and its blocks answer.
#[test]
fn a_whole_at_rest_is_answered_by_its_blocks() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rest.toml");
    let text = "name = \"at rest\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [0, 3]\n\
                [constraints]\nfixed = [\"a\"]\nx = [[\"b\", 4]]\nhorizontal = [[\"a\", \"b\"]]\n\
                vertical = [[\"b\", \"c\"]]\ny = [[\"c\", 3]]\n\
                perpendicular = [[\"a\", \"d\", \"d\", \"c\"]]\nparallel = [[\"a\", \"d\", \"b\", \"c\"]]\n";
    fs::write(&file, text).unwrap();
    let (whole, complaints) = written("result", &["solve", file.to_str().unwrap()]);
    assert_eq!(complaints, [""; 0]);
    assert_eq!(whole["status"], "open");
    let figures = &whole["by_blocks"];
    assert_eq!(complain(&schema_of("figures"), figures), [""; 0]);
    // With d at a, which meets the equations, a-d has no direction.
    assert_eq!(
        (&figures["status"], &figures["count"]),
        (&"complete".into(), &1.into())
    );
    assert_eq!(
        figures["figures"][0]["points"]["d"][1],
        serde_json::json!([3.0, 3.0])
    );
}

/// What made a run stop has a name, and the schemas and the documentation know all of them.
#[test]
fn reasons_to_stop_have_names() {
    let names: Vec<&str> = StopKind::ALL.map(StopKind::name).to_vec();
    let doc = fs::read_to_string("docs/using/programs.md").unwrap();
    for (k, name) in names.iter().enumerate() {
        assert!(!names[..k].contains(name), "{name}");
        assert!(doc.contains(&format!("| `{name}` |")), "{name}");
    }
    let lists = [
        ("result", "/properties/stopped_kind/enum"),
        ("edit", "/properties/stopped_kind/enum"),
        ("comparison", "/$defs/row/properties/stopped_kind/enum"),
    ];
    for (kind, place) in lists {
        let text = fs::read_to_string(format!("docs/schema/{kind}.schema.json")).unwrap();
        let schema: Value = serde_json::from_str(&text).unwrap();
        let list = schema.pointer(place).unwrap_or_else(|| panic!("{kind}"));
        let all = names.iter().map(|&name| Value::from(name));
        let all: Vec<Value> = all.chain([Value::Null]).collect();
        assert_eq!(list, &Value::from(all), "{kind}");
    }
    let closed = &solve(&["problems/octahedron.toml"])[0];
    assert!(closed["reason"].is_null() && closed["stopped_kind"].is_null());
    let first = &solve(&["problems/octahedron.toml", "--first"])[0];
    assert!(first["reason"].is_string());
    assert!(["enough", "turns_back"].contains(&first["stopped_kind"].as_str().unwrap()));
}
