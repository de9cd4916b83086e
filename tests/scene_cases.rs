//! Small files as exporters write them, of `tests/cases/`: what is drawn of each, and what is said.

use serde_json::Value;
use std::path::PathBuf;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::frame::Frame;
use wheatstone_golden::scene::{open, Cull, Geometry, Options, Scene, SceneError};
use wheatstone_golden::setup;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

const SIZE: [u32; 2] = [160, 120];

fn folder() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/cases"))
}

fn cases() -> Vec<Value> {
    let text = std::fs::read_to_string(folder().join("cases.json")).expect("the cases");
    let mut all: Value = serde_json::from_str(&text).expect("JSON");
    let Value::Array(cases) = all["cases"].take() else { panic!("no list of cases") };
    assert_eq!(cases.len(), 29);
    cases
}

fn opened(file: &str) -> Result<Scene, SceneError> {
    open(&folder().join(file).display().to_string(), Some(SIZE), None)
}

fn polygons(scene: &Scene, cull: Cull) -> Geometry {
    let options = Options { cull, ..Options::default() };
    scene.geometry(&Formats::new(&Config::DEFAULT), &options).expect("a legal scene")
}

/// Both views, drawn directly and by the hybrid.
fn views(scene: &Scene, cull: Cull) -> [(&'static str, [Frame; 2]); 2] {
    let config = Config::DEFAULT;
    let geometry = polygons(scene, cull);
    let job = Job::of(&geometry, config, setup::Options::new(&config), Lookup::Nearest);
    [("direct", job.direct()), ("hybrid", job.derived(false).0.eyes)]
}

fn has_hue([r, g, b]: [u8; 3], hue: &str, least: u8) -> bool {
    let only = |a: u8, b: u8, c: u8| a > 60 && a / 2 > b.max(c);
    match hue {
        "red" => only(r, g, b),
        "green" => only(g, b, r),
        "blue" => only(b, r, g),
        "grey" => r == g && g == b && r > 0 && r >= least,
        "background" => [r, g, b] == [0x28, 0x2c, 0x34],
        _ => panic!("no such hue: {hue}"),
    }
}

#[test]
fn every_case_is_drawn_or_refused_as_a_person_would_say() {
    for case in cases() {
        let file = case["file"].as_str().expect("a name");
        let scene = match (opened(file), case["expect"].as_str()) {
            (Ok(scene), Some("drawn")) => scene,
            (Err(error), Some("refused")) => {
                assert!(error.to_string().contains(&format!("{file}:1: v: ")), "{error}");
                continue;
            }
            (result, expected) => panic!("{file}: {expected:?}, but {:?}", result.err()),
        };
        let cull = if case["options"].is_null() { Cull::None } else { Cull::Back };
        let mut warnings = scene.warnings.lines();
        warnings.extend(polygons(&scene, cull).counts.nothing());
        let says = case["says"].as_str().unwrap_or_default();
        let name = |line: &String| line.rsplit('/').next().map(str::to_owned);
        let first = warnings.iter().find_map(name).unwrap_or_default();
        assert_eq!(case["warns"].as_bool(), (!warnings.is_empty()).then_some(true), "{warnings:?}");
        assert!(first.starts_with(says) && says.is_empty() == warnings.is_empty(), "{warnings:?}");

        for (method, frames) in views(&scene, cull) {
            for pixel in case["pixels"].as_array().expect("a list") {
                let number = |k: usize| pixel[k].as_u64().unwrap_or_default() as usize;
                let (hue, least) = (pixel[2].as_str().expect("a hue"), number(3) as u8);
                for frame in &frames {
                    let colour = frame.colour[number(1) * frame.width as usize + number(0)];
                    assert!(has_hue(colour, hue, least), "{file}, {method}: {pixel}: {colour:?}");
                }
            }
        }
    }
}

#[test]
fn the_order_of_statements_and_faces_does_not_matter() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let drawn = |mesh: &str, material: &str| {
        let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text);
        put("m.mtl", material).and(put("m.obj", mesh)).expect("written");
        let name = folder.path().join("m.obj").display().to_string();
        let scene = open(&name, Some(SIZE), None).expect("well-formed");
        assert_eq!(scene.warnings.count(), 0);
        views(&scene, Cull::None)[0].1.clone().map(|frame| frame.colour)
    };
    let mesh = "mtllib m.mtl\nv -2 -1 0\nv 2 -1 0\nv 2 1 0\nusemtl m\nf 1 2 3\n";
    let of = |lines: &str| drawn(mesh, &format!("newmtl m\nKd 1 0 0\n{lines}"));
    let alone = of("d 0.75\n");
    assert!(of("d 0.75\nTr 0.5\n") == alone && of("Tr 0.5\nd 0.75\n") == alone);
    assert!(of("Tr 0.25\n") == alone && of("d 1\n") != alone);
    // Transparent texels before and behind an opaque face.
    let [a, b] = ["10-alpha-texture/a.obj", "10-alpha-texture/b.obj"].map(|file| {
        let scene = opened(file).expect("well-formed");
        views(&scene, Cull::None)[0].1.clone().map(|frame| frame.colour)
    });
    assert!(a == b);
}
