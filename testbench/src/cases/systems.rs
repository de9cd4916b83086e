//! Cases of the complete systems: random polygons, bad setups, scenes.

use super::case::Case;
use super::polygons::{crowd, job, options, random_polygons, random_tape, tilt};
use super::recorded::{simply, whole};
use super::shapes::{at_depths, kinds, largest, raised, spoilable, stretched, Large, HEIGHTS};
use super::spoiler::Spoiler;
use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::{Op, PrimaryBeat};
use wheatstone_golden::primary::Sink;
use wheatstone_golden::record::Tape;
use wheatstone_golden::setup::{Arrangement, Eyes, Options, Polygon, Sampling};
use wheatstone_golden::targets::Target;

/// Random polygons in a small window, so that they overlap: about `beats` beats.
pub fn random(target: Target, config: &Config, seed: u64, beats: usize) -> Case {
    let (nothing, tape) = random_tape(config, seed, beats, target == Target::Minimal);
    whole(target, &nothing, "random polygons", tape)
}

/// Every kind of bad setup between good polygons, beats that no polygon owns, polygons on top of
/// each other, and both eyes on one display that is turned, where a place passes every
/// part of the way to it.
pub fn directed(target: Target, config: &Config) -> Vec<Case> {
    let f = Formats::new(config);
    let size = [48, 36];
    let minimal = target == Target::Minimal;
    let polygons = random_polygons(5, f, size, 80);
    let options = Options { cost_rule: false, ..Options::new(config) };
    let good = job(config, options, size, &polygons);
    let mut tape = Tape::new(&good, minimal, false);
    let stereo = target == Target::Stereo;
    let ways = if stereo { 11 } else { 12 };
    good.run(minimal, &mut Spoiler { sink: tape.sink(), formats: f, polygon: 0, ways });
    let spoiled = whole(target, &good, "bad setups", tape);

    // Inside, stray beats show whatever the registers held after power-up, so nothing inside is
    // compared; what follows is drawn for one eye, which is seen at the outputs.
    let mut alone = polygons[..12].to_vec();
    alone.retain(|polygon| polygon.vertices.len() == 3);
    alone.iter_mut().for_each(|p| p.eyes = Eyes::One(Eye::BOTH[p.id as usize % 2]));
    let alone = job(config, options, size, &alone);
    let mut tape = Tape::new(&alone, minimal, false);
    let stray =
        PrimaryBeat { op: Op::Step, mask: Mask::new(1, &f), centre: true, ..Default::default() };
    tape.sink().beat(&stray);
    tape.sink().beat(&PrimaryBeat { op: Op::Row, last: true, ..stray });
    alone.run(minimal, tape.sink());
    let mut stray = whole(target, &alone, "beats before the first polygon", tape);
    stray.probes.clear();

    let crowd = crowd(6, f, [16, 12], 240);
    let crowd = job(config, options, [16, 12], &crowd);
    let crowded = simply(target, &crowd, "polygons on top of each other");

    let turned = Options { arrangement: Arrangement::Rotated, single: true, ..options };
    let turned = job(config, turned, size, &polygons[..12]);
    let turned = simply(target, &turned, "one display, rotated");

    // The secondary leaves through the first and the last row.
    let raised: Vec<Polygon> = polygons.iter().map(|polygon| raised(polygon, f, size[1])).collect();
    let raised = job(config, options, size, &raised);
    let raised = config.tilt.then(|| simply(target, &raised, "one eye raised"));

    let mut cleared = Case { name: "bad setups, error cleared".into(), ..spoiled.clone() };
    cleared.statics[ERROR_CLEAR] = 1;
    cleared.flags = vec![0];

    // Inside the stereo pipeline there are no beats but the primary's own.
    let stray = Some(stray).filter(|_| !stereo);
    let largest = largest(config).into_iter().map(|large| {
        let Large { name, size, options, polygons } = large;
        simply(target, &job(config, options, size, &polygons), &name)
    });
    let every = (target == Target::Hybrid).then(|| every_kind(config));
    let rest = [crowded, turned, cleared].into_iter().chain(raised).chain(largest).chain(every);
    [spoiled].into_iter().chain(stray).chain(rest).collect()
}

/// Place of `error_clear` among the static inputs of a system.
const ERROR_CLEAR: usize = 3;

/// The case of a pack: everything that a system does with polygons and with what are none, on two displays or
/// on one, there with the error flag held clear. After beats that no polygon owns come polygons every other one of which is void, then every
/// mode, ratio and edge sign, then crowds and random polygons in turn, about `beats` beats of them, each of
/// these with other choices of setup.
pub fn for_pack(target: Target, config: &Config, seed: u64, beats: usize, single: bool) -> Case {
    let f = Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let minimal = target == Target::Minimal;
    let height = rng.u32(24..60);
    // A display that has room for the views in every arrangement.
    let size = [rng.u32(height + 1..2 * height), height];
    let chosen = |options: Options| Options { single, ..options };
    let largest = chosen(Options { arrangement: Arrangement::AboveBelow, ..Options::new(config) });
    let nothing = job(config, largest, size, &[]);
    let mut tape = Tape::new(&nothing, minimal, false);

    if target != Target::Stereo {
        let mask = Mask::new(1, &f);
        let stray = PrimaryBeat { op: Op::Step, mask, centre: true, ..Default::default() };
        tape.sink().beat(&stray);
        tape.sink().beat(&PrimaryBeat { op: Op::Row, last: true, ..stray });
    }
    let derived = chosen(Options { cost_rule: false, ..Options::new(config) });
    let ways = if target == Target::Stereo { 11 } else { 12 };
    let polygons = at_depths(16_000_000, spoilable(minimal, 2 * ways, &f));
    let mut spoiler = Spoiler { sink: tape.sink(), formats: f, polygon: 0, ways };
    job(config, derived, size, &polygons).run(minimal, &mut spoiler);

    let white = [0.6, 2.4, 7.0, 13.0, 27.0].map(|ratio| {
        let mut polygon = stretched(Eye::Left, ratio, HEIGHTS[1], false, &f);
        polygon.vertices.iter_mut().for_each(|vertex| vertex.colour = [Rgba([255; 4]); 2]);
        polygon
    });
    let polygons = at_depths(15_000_000, kinds(&f).into_iter().chain(white));
    for (sampling, part) in [Sampling::Automatic, Sampling::Average].into_iter().zip([0, 1]) {
        let some: Vec<Polygon> = polygons.iter().skip(part).step_by(2).cloned().collect();
        job(config, Options { sampling, ..derived }, size, &some).run(minimal, tape.sink());
    }

    let mut drawn = 0;
    for batch in 0..beats {
        let mut polygons = match batch % 3 {
            1 => crowd(rng.u64(..), f, [size[0].min(16), size[1].min(12)], 48),
            _ => random_polygons(rng.u64(..), f, size, 8),
        };
        if config.tilt {
            polygons.iter_mut().for_each(|polygon| tilt(polygon, rng));
        }
        let options = chosen(options(rng, config));
        drawn += job(config, options, size, &polygons).run(minimal, tape.sink()).beats();
        if drawn >= beats as u64 {
            break;
        }
    }
    let mut case = whole(target, &nothing, "random polygons, void ones and strays", tape);
    case.probes.clear();
    if single {
        // The flag may be held clear.
        case.statics[ERROR_CLEAR] = 1;
        case.flags = vec![0];
    }
    case
}

/// Polygons of every mode and, where a secondary is derived, every class of the mapping ratio with every
/// triple of edge signs.
fn every_kind(config: &Config) -> Case {
    let polygons = kinds(&Formats::new(config));
    let job =
        job(config, Options { cost_rule: false, ..Options::new(config) }, [200, 8], &polygons);
    let mut tape = Tape::new(&job, false, false);
    job.run(false, tape.sink());
    let name = "every mode, ratio and edge sign";
    Case { all_stalls: true, ..whole(Target::Hybrid, &job, name, tape) }
}
