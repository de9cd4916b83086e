//! Cases: what is fed to a target and what the golden model says must come out.
//!
//! A case is made before the simulator runs, so that a mismatch can be repeated from the seed alone.
//! Random cases are constrained: they are legal streams, weighted towards the edges of ranges.

mod case;
mod combinational;
mod interpolators;
mod pixels;
mod polygons;
mod primary;
mod recorded;
mod scene;
mod shapes;
mod spoiler;
mod systems;

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::targets::Target;

pub use case::Case;
pub use polygons::random_polygons;
pub use primary::monocular;
pub use recorded::{output_number, recorded, recorded_unit};
pub(crate) use scene::{case_of, part};
pub use scene::{scene_head, Head};

/// A random case of about `beats` beats for a unit or a system.
pub fn random(target: Target, config: &Config, seed: u64, beats: usize) -> Case {
    match target {
        Target::XInterpolator => interpolators::x(config, seed, beats),
        Target::YInterpolator => interpolators::y(config, seed, beats),
        Target::EdgeInterpolator => interpolators::edge(config, seed, beats),
        Target::Sampler => pixels::sampler(config, seed, beats),
        Target::Filter => pixels::filter(config, seed, beats),
        Target::Coverage => combinational::coverage_case(config, seed, beats),
        Target::Blend => combinational::blend_case(config, seed, beats),
        Target::Display => combinational::display_case(config, seed, beats),
        Target::Redirect => combinational::redirect_case(config, seed, beats),
        Target::Traversal | Target::Primary => primary::random(target, config, seed, beats),
        Target::Mono => primary::mono_random(config, seed, beats),
        Target::Minimal | Target::Hybrid | Target::Stereo => {
            systems::random(target, config, seed, beats)
        }
    }
}

/// Cases of the packs of a target, each with what its folder's name has behind the target's: about `beats`
/// random beats in each, and with them what random beats rarely are. Static inputs that say which of two ways a target works have
/// a pack for either.
pub fn for_packs(
    target: Target,
    config: &Config,
    seed: u64,
    beats: usize,
) -> Vec<(&'static str, Case)> {
    let one = |case| vec![("", case)];
    match target {
        Target::XInterpolator => one(interpolators::x_for_pack(config, seed, beats)),
        Target::Sampler => one(pixels::sampler_for_pack(config, seed, beats)),
        Target::Filter => one(pixels::filter_for_pack(config, seed, beats)),
        Target::Redirect => [("", false), ("-single", true)]
            .map(|(suffix, single)| {
                (suffix, combinational::redirect_slots(config, seed, beats, single))
            })
            .to_vec(),
        Target::Traversal | Target::Primary => one(primary::for_pack(target, config, seed, beats)),
        Target::Mono => [("", Eye::Left), ("-right", Eye::Right)]
            .map(|(suffix, eye)| (suffix, primary::mono_for_pack(config, seed, beats, eye)))
            .to_vec(),
        Target::Minimal | Target::Hybrid | Target::Stereo => [("", false), ("-single", true)]
            .map(|(suffix, single)| {
                (suffix, systems::for_pack(target, config, seed, beats, single))
            })
            .to_vec(),
        _ => one(random(target, config, seed, beats)),
    }
}

/// The directed cases of a target: corners that random beats rarely meet.
pub fn directed(target: Target, config: &Config) -> Vec<Case> {
    match target {
        Target::XInterpolator => vec![interpolators::x_corners(config)],
        Target::YInterpolator => vec![interpolators::y_corners(config)],
        Target::EdgeInterpolator => vec![interpolators::edge_corners(config)],
        Target::Sampler => vec![pixels::sampler_corners(config)],
        Target::Filter => vec![pixels::filter_corners(config)],
        Target::Coverage => vec![combinational::coverage_corners(config)],
        Target::Blend => vec![combinational::blend_corners(config)],
        Target::Display => {
            let widest = Formats::new(config).max_size;
            [1, widest].map(|width| combinational::display_corners(config, width)).to_vec()
        }
        Target::Redirect => {
            [false, true].map(|single| combinational::redirect_corners(config, single)).to_vec()
        }
        Target::Traversal | Target::Primary => vec![primary::corners(target, config)],
        Target::Mono => {
            let ones = Eye::BOTH.map(|eye| {
                [primary::mono_crowd(config, eye), primary::mono_barely_whole(config, eye)]
            });
            ones.into_iter().flatten().chain(primary::mono_large(config)).collect()
        }
        Target::Minimal | Target::Hybrid | Target::Stereo => systems::directed(target, config),
    }
}
