//! Monocular pipeline against direct rendering.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::frame::{Frames, Scissor};
use wheatstone_golden::pipeline::mono::Mono;
use wheatstone_golden::pipeline::{Edges, Planes, PrimaryBeat, Setup, Walk};
use wheatstone_golden::primary::Sink;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::setup::{Eyes, Options, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// Draws from the records alone; beats are ignored.
struct Pipeline {
    mono: Mono,
    frames: Frames,
}

impl Sink for Pipeline {
    fn polygon(&mut self, id: u32) {
        self.frames.id = id;
    }
    fn walk(&mut self, walk: &Walk, planes: &Planes) {
        self.mono.part(walk, planes, &mut self.frames);
    }
    fn records(&mut self, _: &Setup, _: &Edges) {}
    fn beat(&mut self, _: &PrimaryBeat) {}
}

#[test]
fn triangles_of_every_class_are_drawn_as_directly() {
    for config in [Config::DEFAULT, Config::PAPER, Config::FULL] {
        for (eye, seed) in Eye::BOTH.into_iter().zip(1..) {
            let mut triangles = Triangles::new(seed, Formats::new(&config), 160, 120);
            let polygons: Vec<Polygon> = (0..1200)
                .map(|id| {
                    let class = Class::ALL[id as usize % Class::ALL.len()];
                    Polygon { id, eyes: Eyes::One(eye), ..triangles.triangle(class) }
                })
                .collect();
            let job = Job {
                config,
                options: Options::new(&config),
                width: 160,
                height: 120,
                background: [20, 40, 60],
                scissor: Scissor::default(),
                polygons: &polygons,
                textures: &[],
                lookup: Lookup::Nearest,
            };
            let mono = Mono::new(&config, job.width, eye);
            let mut pipeline = Pipeline { mono, frames: job.frames(false) };
            job.run(false, &mut pipeline);
            assert!(pipeline.frames.eyes == job.direct(), "{eye:?} of {config:?}");
            assert!(pipeline.frames.written[eye as usize] > 10_000);
        }
    }
}
