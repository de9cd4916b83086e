//! The primary pipeline of registers and adders against the golden primary, which computes every pixel
//! anew.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::frame::Scissor;
use wheatstone_golden::pipeline::primary::Primary as Pipeline;
use wheatstone_golden::pipeline::{Edges, Planes, PrimaryBeat, Setup, Walk};
use wheatstone_golden::primary::Sink;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::scene::{self, builtin};
use wheatstone_golden::setup::{Arrangement, Options, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

const CONFIGS: [Config; 4] =
    [Config::DEFAULT, Config::PAPER, Config::FULL, Config { antialias: false, ..Config::FULL }];

/// Compares the beats of every part with those of the pipeline.
struct Comparison {
    pipeline: Pipeline,
    waiting: std::collections::VecDeque<PrimaryBeat>,
    parts: u64,
    beats: u64,
    polygon: u32,
}

impl Comparison {
    fn new(job: &Job) -> Comparison {
        let pipeline = Pipeline::new(&job.config, job.width);
        Comparison { pipeline, waiting: Default::default(), parts: 0, beats: 0, polygon: 0 }
    }

    fn finish(&self) {
        assert!(self.waiting.is_empty(), "pipeline sends more beats of polygon {}", self.polygon);
    }
}

impl Sink for Comparison {
    fn polygon(&mut self, id: u32) {
        self.finish();
        self.polygon = id;
    }
    fn records(&mut self, _: &Setup, _: &Edges) {}
    fn walk(&mut self, walk: &Walk, planes: &Planes) {
        self.finish();
        self.parts += 1;
        let Comparison { pipeline, waiting, .. } = self;
        pipeline.part(walk, planes, |beat| waiting.push_back(*beat));
    }
    fn beat(&mut self, beat: &PrimaryBeat) {
        self.beats += 1;
        let sent = self.waiting.pop_front();
        assert_eq!(sent.as_ref(), Some(beat), "polygon {} beat {}", self.polygon, self.beats);
    }
}

fn compare(job: &Job) -> Comparison {
    let mut comparison = Comparison::new(job);
    job.run(false, &mut comparison);
    comparison.finish();
    comparison
}

fn job(config: Config, options: Options, polygons: &[Polygon]) -> Job<'_> {
    let (background, textures, lookup) = ([20, 40, 60], &[], Lookup::Nearest);
    let [width, height] = [160, 120];
    let scissor = Scissor::default();
    Job { config, options, width, height, background, scissor, polygons, textures, lookup }
}

#[test]
fn beats_of_every_class_are_those_of_the_golden_primary() {
    for config in CONFIGS {
        for (seed, class) in Class::ALL.into_iter().enumerate() {
            let mut triangles = Triangles::new(seed as u64, Formats::new(&config), 160, 120);
            let polygons: Vec<Polygon> =
                (0..800).map(|id| Polygon { id, ..triangles.triangle(class) }).collect();
            for cost_rule in [true, false] {
                let arrangement = [Arrangement::Normal, Arrangement::Rotated][seed % 2];
                let options = Options { cost_rule, arrangement, ..Options::new(&config) };
                let drawn = compare(&job(config, options, &polygons));
                assert!(drawn.beats > 300, "{}: {} beats", class.name(), drawn.beats);
            }
        }
    }
}

#[test]
fn of_a_polygon_with_more_corners_the_pipeline_tests_the_three_edges_that_end_its_rows() {
    for config in CONFIGS {
        let mut triangles = Triangles::new(3, Formats::new(&config), 160, 120);
        let polygons: Vec<Polygon> =
            (0..200).map(|id| Polygon { id, ..triangles.convex() }).collect();
        let drawn = compare(&job(config, Options::new(&config), &polygons));
        assert!(drawn.parts > 400 && drawn.beats > 40_000, "{} {}", drawn.parts, drawn.beats);
    }
}

#[test]
fn scenes_are_traversed_alike_and_textured_polygons_have_their_lit_colour() {
    for config in [Config::DEFAULT, Config { tilt: false, ..Config::FULL }] {
        for builtin in &builtin::SCENES {
            let scene =
                scene::open(builtin.name, Some([320, 240]), None).expect("a built-in scene");
            let geometry = scene.geometry(&Formats::new(&config), &scene::Options::default());
            let geometry = geometry.expect("it is sound");
            let job = Job::of(&geometry, config, Options::new(&config), Lookup::Nearest);
            let drawn = compare(&Job { textures: &[], ..job });
            assert!(drawn.beats > 500, "{}: {} beats", builtin.name, drawn.beats);
        }
    }
}
