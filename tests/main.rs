//! The acceptance and regression tests of the workspace, one file a unit or feature, in one program: it is
//! linked once, and all its tests run side by side. One file alone: `cargo test -p wheatstone-tests hybrid::`.

mod baseline;
mod bsp;
mod clipping;
mod compare;
mod cost;
mod cover;
mod docs;
mod exact_coverage;
mod faces;
mod figures;
mod formal;
mod formats;
mod height_field;
mod height_grid;
mod hybrid;
mod lint;
mod minimal;
mod module_graph;
mod mono;
mod mutation;
mod opengl;
mod p_buffer;
mod pack_rules;
mod packs_untrusted;
mod picture;
mod planted_bugs;
mod primary;
mod projection;
mod projection_drawn;
mod projection_files;
mod regression;
mod renderer;
mod replay;
mod reproduce;
mod rig;
mod scan_line;
mod scene;
mod scene_builtin;
mod scene_cases;
mod scene_files;
mod scenes_exact;
mod setup;
mod simultaneous;
mod stereo;
mod storage;
mod synth;
mod vectors;
mod walk;
mod warping;
mod wires;

use wheatstone_tests::workspace;

/// Files of the shared library, and those that are tests of the golden crate, are not modules here.
#[test]
fn every_file_is_run() {
    let text = |path: &str| std::fs::read_to_string(workspace().join(path)).expect("a file");
    let (here, golden) = (text("tests/main.rs"), text("golden/Cargo.toml"));
    for entry in std::fs::read_dir(workspace().join("tests")).expect("the folder") {
        let name = entry.expect("an entry").file_name().to_string_lossy().into_owned();
        let Some(module) = name.strip_suffix(".rs") else { continue };
        let is_module = here.contains(&format!("mod {module};"));
        let is_run = is_module || golden.contains(&format!("../tests/{name}"));
        assert!(
            is_run || ["lib", "main", "visibility"].contains(&module),
            "{name} is run by nothing"
        );
    }
}
