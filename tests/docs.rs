//! Documentation: generated parts are current, links lead somewhere, diagrams name the registers that
//! the Verilog has, and every unit has its four files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use wheatstone_golden::document::COMMAND;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::scene;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::cases::scene_head;
use wheatstone_testbench::generated::Generated;
use wheatstone_testbench::pack::{self, Drawn, Origin, PackInfo, SceneOrigin};
use wheatstone_testbench::settings::Settings;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: impl AsRef<Path>) -> String {
    let path = workspace().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// All pages, by their paths in the workspace.
fn pages() -> Vec<String> {
    let docs = fs::read_dir(workspace().join("docs")).expect("docs can be listed");
    let names = docs.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let pages = names.filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}"));
    let top = ["README.md", "ARCHITECTURE.md"].map(String::from);
    pages.chain(top.into_iter().filter(|page| workspace().join(page).exists())).collect()
}

#[test]
fn generated_parts_are_current() {
    for generated in Generated::all() {
        let path = generated.path();
        let present = read(&path);
        let renewed = generated.renewed(&present, &workspace());
        let renewed = renewed.unwrap_or_else(|error| panic!("{error}"));
        let differs = present.lines().zip(renewed.lines()).find(|(old, new)| old != new);
        assert!(present == renewed, "{path} is not current, run: {COMMAND}\n{differs:#?}");
    }
}

#[test]
fn every_page_is_in_the_list_of_pages() {
    let list = read("docs/README.md");
    for page in pages() {
        let Some(name) = page.strip_prefix("docs/") else { continue };
        assert!(
            name == "README.md" || list.contains(&format!("]({name})")),
            "docs/README.md lacks {name}"
        );
    }
}

#[test]
fn every_unit_has_model_verilog_test_and_page() {
    for target in Target::ALL {
        let name = target.name();
        for path in [
            format!("golden/src/pipeline/{name}.rs"),
            format!("rtl/sam_{name}.v"),
            format!("tests/{name}.rs"),
            format!("docs/{name}.md"),
        ] {
            assert!(workspace().join(&path).exists(), "{path} is missing");
        }
    }
}

/// Targets of the Markdown links of a page.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    targets.map(|(target, _)| target).filter(|target| !target.contains("://"))
}

/// The anchors of a page's headings, as GitHub makes them.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let title = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = title.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

#[test]
fn links_lead_somewhere() {
    let mut followed = 0;
    for page in pages() {
        let text = read(&page);
        for link in links(&text) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let folder = Path::new(&page).parent().unwrap().to_path_buf();
            let path = if file.is_empty() { PathBuf::from(&page) } else { folder.join(file) };
            assert!(workspace().join(&path).exists(), "{page}: no {}", path.display());
            if !anchor.is_empty() {
                let known = anchors(&read(&path));
                assert!(known.contains(anchor), "{page}: no heading {link}, but {known:?}");
            }
            followed += 1;
        }
    }
    assert!(followed > 60, "only {followed} links");
}

#[test]
fn files_that_pages_name_exist() {
    let roots = ["", "golden/src", "testbench/src", "tests", "docs"];
    for page in pages() {
        for name in read(&page).split('`').skip(1).step_by(2) {
            let ending = [".rs", ".v", ".vh", ".md", ".toml"].iter().any(|end| name.ends_with(end));
            // Names with a space are commands, those with brackets or of a unit U stand for many.
            let many = name.contains([' ', '<', '{', '*']) || name.contains("U.");
            if !ending || many || !name.contains('/') {
                continue;
            }
            let found = roots.iter().any(|root| workspace().join(root).join(name).exists());
            assert!(found, "{page}: no file {name}");
        }
    }
}

/// Words of a text that are names of registers.
fn registers(text: &str) -> BTreeSet<&str> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    words.filter(|word| word.ends_with("_q") && word.len() > 2).collect()
}

#[test]
fn diagrams_name_the_registers_of_the_verilog() {
    for target in Target::ALL {
        let page = read(format!("docs/{}.md", target.name()));
        let verilog = read(format!("rtl/sam_{}.v", target.name()));
        let shown = registers(&page);
        let declared = verilog.lines().map(str::trim_start).filter(|line| line.starts_with("reg "));
        for register in declared.flat_map(registers) {
            assert!(shown.contains(register), "docs/{}.md lacks {register}", target.name());
        }
        // Registers of a system may be those of any module that its page links to.
        let linked: Vec<&str> = links(&page).filter(|link| link.ends_with(".v")).collect();
        let all: String = linked.iter().map(|link| read(Path::new("docs").join(link))).collect();
        for register in shown {
            assert!(registers(&all).contains(register), "{}: no {register}", target.name());
        }
    }
}

/// The pack of a scene in a file: its manifest has every field.
pub(crate) fn pack_of_a_file(out: &Path) -> PackInfo {
    let settings = Settings::new::<&str>("default", &[]).unwrap();
    let scene = scene::open("ramp", Some([32, 24]), None).unwrap();
    let geometry = scene.geometry(&Formats::new(&settings.config), &Default::default()).unwrap();
    let job = Job::of(&geometry, settings.config, settings.options, settings.lookup);
    let head = scene_head(Target::Hybrid, &job, "ramp", 8).unwrap();
    let drawn = Drawn {
        name: "ramp.obj",
        file: Some(b"f"),
        rig: &scene.rig,
        rig_file: Some("{\"light\": {\"colour\": [1, 0.50, 0]}}\n"),
        settings: &settings,
        cull: false,
        wire: false,
        job: &job,
    };
    let origin = Origin { scene: Some(SceneOrigin::new(&drawn, &head)), ..Origin::default() };
    pack::write(&head.case, &origin, &"0".repeat(64), out).unwrap()
}

#[test]
fn the_page_of_vectors_explains_every_field_of_a_manifest() {
    let folder = tempfile::tempdir().unwrap();
    let info = pack_of_a_file(folder.path());
    let text = fs::read_to_string(info.folder.join(pack::MANIFEST)).unwrap();
    let page = read("docs/vectors.md");
    fn keys(value: &serde_json::Value, all: &mut BTreeSet<String>) {
        match value {
            serde_json::Value::Object(object) => {
                for (key, value) in object {
                    all.insert(key.clone());
                    keys(value, all);
                }
            }
            serde_json::Value::Array(array) => array.iter().for_each(|value| keys(value, all)),
            _ => {}
        }
    }
    let mut all = BTreeSet::new();
    keys(&serde_json::from_str(&text).unwrap(), &mut all);
    for key in ["answers", "open", "file_blake3", "polygons_of"] {
        assert!(all.contains(key), "no {key} in {all:?}");
    }
    for key in all {
        assert!(page.contains(&format!("`{key}`")), "docs/vectors.md: nothing about {key}");
    }
    for entry in fs::read_dir(&info.folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let stream = name.ends_with(".mem") || name.ends_with(".bin");
        assert!(stream || page.contains(&format!("`{name}`")), "nothing about {name}");
    }
}

/// Files of a folder and those below it, by their paths in it.
fn content(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.unwrap()) {
        let name = PathBuf::from(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            let below = content(&entry.path()).into_iter();
            all.extend(below.map(|(path, bytes)| (name.join(path), bytes)));
        } else {
            all.insert(name, fs::read(entry.path()).unwrap_or_default());
        }
    }
    all
}

/// Scripts must run, and hashes of packs be the same, however git is told to end lines.
#[test]
fn a_checkout_has_the_same_bytes_whatever_ends_lines() {
    if !workspace().join(".git").exists() {
        return;
    }
    let check_out = |autocrlf: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        let mut git = Command::new("git");
        git.current_dir(workspace()).args(["-c", &format!("core.autocrlf={autocrlf}")]);
        git.args(["checkout-index", "--all", "--force"]);
        git.arg(format!("--prefix={}/", folder.path().display()));
        assert!(git.status().expect("git runs").success());
        content(folder.path())
    };
    let (plain, other) = (check_out("false"), check_out("true"));
    assert!(plain.len() > 100 && plain.len() == other.len());
    let changed: Vec<_> = plain.iter().filter(|(path, bytes)| other[*path] != **bytes).collect();
    let changed: Vec<_> = changed.into_iter().map(|(path, _)| path).collect();
    assert!(changed.is_empty(), "{} files, such as {:?}", changed.len(), changed[0]);
}
