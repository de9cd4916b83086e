//! Stereo pipeline: from register values alone both images of a scene, as by direct rendering.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::frame::Frames;
use wheatstone_golden::pipeline::observer::Blind;
use wheatstone_golden::pipeline::stereo::{PartRecords, Stereo};
use wheatstone_golden::pipeline::{Edges, Planes, PrimaryBeat, Setup, Walk};
use wheatstone_golden::primary::Sink;
use wheatstone_golden::scene::{self, builtin};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// Draws from the records alone; beats are ignored.
struct Pipeline {
    stereo: Stereo,
    records: PartRecords,
    frames: Frames,
}

impl Sink for Pipeline {
    fn polygon(&mut self, id: u32) {
        self.frames.id = id;
    }
    fn walk(&mut self, walk: &Walk, planes: &Planes) {
        (self.records.walk, self.records.planes) = (*walk, *planes);
    }
    fn records(&mut self, setup: &Setup, edges: &Edges) {
        (self.records.setup, self.records.edges) = (*setup, *edges);
        self.stereo.part(&self.records, &mut self.frames, &mut Blind);
    }
    fn beat(&mut self, _: &PrimaryBeat) {}
}

#[test]
fn register_values_draw_scenes_as_direct_rendering_does() {
    let exact = Config { tilt: false, ..Config::FULL };
    for config in [exact, Config { antialias: false, ..exact }] {
        for builtin in &builtin::SCENES {
            let name = builtin.name;
            let scene = scene::open(name, Some([320, 240]), None).expect("a built-in scene");
            let geometry = scene.geometry(&Formats::new(&config), &scene::Options::default());
            let geometry = geometry.expect("it is sound");
            let textured = !geometry.textures.is_empty();
            let job = Job::of(&geometry, config, Options::new(&config), Lookup::Nearest);
            let job = job.untextured();
            let mut pipeline = Pipeline {
                stereo: Stereo::new(&config, job.width, job.height, false),
                records: PartRecords::default(),
                frames: job.frames(false),
            };
            job.run(false, &mut pipeline);
            assert!(!pipeline.stereo.error(), "{name}: a polygon was refused");
            for (eye, (ours, direct)) in pipeline.frames.eyes.iter().zip(&job.direct()).enumerate()
            {
                assert!(ours.depth == direct.depth, "{name}, eye {eye}: depths differ");
                assert!(ours.id == direct.id, "{name}, eye {eye}: ids differ");
                // A textured polygon's lit colour is averaged, not interpolated.
                assert!(textured || ours.colour == direct.colour, "{name}, eye {eye}: colours");
            }
        }
    }
}
