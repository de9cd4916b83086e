//! Whole scenes: the hybrid against direct rendering, with the cost rule off and on.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::picture::{frame_picture, psnr};
use wheatstone_golden::record::Tape;
use wheatstone_golden::scene::{self, builtin, Geometry};
use wheatstone_golden::setup::{Options, Sampling, Specular};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

const SIZE: [u32; 2] = [320, 240];

fn geometry(name: &str, config: &Config) -> Geometry {
    let scene = scene::open(name, Some(SIZE), None).expect("a built-in scene");
    scene.geometry(&Formats::new(config), &scene::Options::default()).expect("it is sound")
}

fn job(config: Config, options: Options, geometry: &Geometry) -> Job<'_> {
    Job::of(geometry, config, options, Lookup::Bilinear)
}

fn quality(name: &str, config: Config, options: Options) -> [f64; 2] {
    let geometry = geometry(name, &config);
    let job = job(config, options, &geometry);
    let (frames, _) = job.derived(false);
    let direct = job.direct();
    Eye::BOTH.map(|eye| {
        let (ours, theirs) = (&frames.eyes[eye as usize], &direct[eye as usize]);
        psnr(&frame_picture(ours), &frame_picture(theirs)).expect("pictures of one size")
    })
}

/// Both images of every untextured scene, bit for bit; of a textured one ids and depths.
fn compare(config: Config) {
    for builtin in &builtin::SCENES {
        let geometry = geometry(builtin.name, &config);
        for cost_rule in [false, true] {
            let options = Options { cost_rule, ..Options::new(&config) };
            let job = job(config, options, &geometry);
            let (frames, counts) = job.derived(false);
            let direct = job.direct();
            for (eye, (ours, theirs)) in frames.eyes.iter().zip(&direct).enumerate() {
                let name = builtin.name;
                assert!(ours.depth == theirs.depth, "{name}, eye {eye}: depths differ");
                assert!(ours.id == theirs.id, "{name}, eye {eye}: ids differ");
                if geometry.textures.is_empty() {
                    assert!(ours.colour == theirs.colour, "{name}, eye {eye}: colours differ");
                }
            }
            println!("{} {cost_rule}: {} derived", builtin.name, counts.derived);
            assert!(cost_rule || counts.derived > 0 || builtin.name == "polygons");
        }
    }
}

#[test]
fn integrated_colour_and_interpolated_depth_are_exact() {
    compare(Config { tilt: false, antialias: false, ..Config::FULL });
}

#[test]
fn and_so_they_are_with_antialiasing() {
    compare(Config { tilt: false, ..Config::FULL });
}

#[test]
fn nearest_sampling_keeps_50_db_on_gouraud_shading() {
    let config = Config::DEFAULT;
    let options = Options { sampling: Sampling::Nearest, ..Options::new(&config) };
    for name in ["teapot", "ramp", "exclusive", "ratio"] {
        let quality = quality(name, config, options);
        println!("{name}: {:.1} and {:.1} dB", quality[0], quality[1]);
        assert!(quality.iter().all(|&db| db >= 50.0), "{name}: {quality:?}");
    }
}

/// Figures of the other builds; printed, and held only to what nobody would accept less of.
#[test]
fn other_builds_are_measured() {
    let full = Config { tilt: false, ..Config::FULL };
    let approximation =
        Options { specular: Specular::Approximation, ..Options::new(&Config::DEFAULT) };
    for (what, config, options) in [
        ("default", Config::DEFAULT, Options::new(&Config::DEFAULT)),
        ("highlights approximated", Config::DEFAULT, approximation),
        ("paper", Config::PAPER, Options::new(&Config::PAPER)),
        ("full", full, Options::new(&full)),
    ] {
        for name in ["teapot", "room"] {
            let quality = quality(name, config, options);
            println!("{what}, {name}: {:.1} and {:.1} dB", quality[0], quality[1]);
            assert!(quality.iter().all(|&db| db >= 25.0), "{what}, {name}: {quality:?}");
        }
    }
}

/// If nobody watches, the models take short cuts, which must not show.
#[test]
fn watched_and_unwatched_runs_draw_the_same() {
    for config in [Config::DEFAULT, Config::PAPER, Config::FULL] {
        let geometry = geometry("room", &config);
        for minimal in [false, true] {
            let job = job(config, Options::new(&config), &geometry);
            let mut tape = Tape::new(&job, minimal, false);
            job.run(minimal, tape.sink());
            let (frames, _) = job.derived(minimal);
            assert!(tape.frames().eyes == frames.eyes);
            assert!(!tape.is_empty());
        }
    }
}
