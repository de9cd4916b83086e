//! Cases of the complete systems: random polygons, bad setups, scenes.

use super::Case;
use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::frame::Scissor;
use wheatstone_golden::interface::{Direction, Table};
use wheatstone_golden::pipeline::observer::Unit;
use wheatstone_golden::pipeline::{Edges, Mode, Op, Planes, PrimaryBeat, Setup, Walk};
use wheatstone_golden::primary::Sink;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::record::{Recording, Tape};
use wheatstone_golden::setup::{Arrangement, Eyes, Options, Polygon, Sampling, Specular, Vertex};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::{probes, Target};
use wheatstone_golden::texture::Lookup;

/// The case of what a system did for a job, or for a part of it.
pub fn recorded(target: Target, job: &Job, name: &str, recording: &Recording) -> Case {
    let mut case = Case::empty(target, &job.config, name);
    let interface = case.interface();
    case.statics = vec![job.width.into(), job.height.into(), job.options.single.into(), 0];
    let table = |stream: &str| recording.streams.get(stream).cloned().unwrap_or_default();
    let of = |direction: Direction| {
        let streams = interface.streams.iter().filter(move |s| s.direction == direction);
        streams.map(|s| table(s.name)).collect::<Vec<Table>>()
    };
    case.inputs = of(Direction::Input);
    case.outputs = of(Direction::Output);
    case.flags = vec![recording.error.into()];
    for probe in probes(target, &job.config) {
        let empty = || Table::new(&probe.stream.fields);
        let tables = match probe.stream.direction {
            Direction::Input => &recording.inputs,
            Direction::Output => &recording.outputs,
        };
        let table = match probe.unit {
            Unit::Primary => recording.streams.get("beat").cloned(),
            unit => tables.get(&unit).cloned(),
        };
        let table = table.unwrap_or_else(empty);
        case.probes.push((probe, table));
    }
    case
}

/// The instance of a unit that stands for it in a system.
fn instance(target: Target) -> Option<Unit> {
    Some(match target {
        Target::XInterpolator => Unit::XInterpolator,
        Target::YInterpolator => Unit::YInterpolator,
        Target::EdgeInterpolator => Unit::Edge0,
        Target::Sampler => Unit::Sampler,
        Target::Filter => Unit::Filter,
        Target::Coverage => Unit::Coverage,
        Target::Blend => Unit::Blend,
        Target::Display => Unit::Display,
        Target::Redirect => Unit::Redirect,
        Target::Traversal | Target::Primary | Target::Mono => return None,
        Target::Minimal | Target::Hybrid | Target::Stereo => return None,
    })
}

/// The case of what a unit did inside the hybrid, or in the primary pipeline before it.
pub fn recorded_unit(target: Target, job: &Job, name: &str, recording: &Recording) -> Case {
    if let Target::Traversal | Target::Primary | Target::Mono = target {
        return super::primary::recorded(target, job, name, recording);
    }
    let mut case = Case::empty(target, &job.config, name);
    let Some(unit) = instance(target) else { return case };
    if let Some(table) = recording.inputs.get(&unit) {
        case.inputs = vec![table.clone()];
    }
    if let Some(table) = recording.outputs.get(&unit) {
        case.outputs = vec![table.clone()];
    }
    if target == Target::Redirect {
        case.outputs = ["left", "right"].map(|stream| recording.streams[stream].clone()).to_vec();
    }
    case.statics = match target {
        Target::XInterpolator | Target::Display => vec![job.width.into()],
        Target::YInterpolator => vec![job.height.into()],
        Target::Redirect => vec![job.options.single.into()],
        _ => Vec::new(),
    };
    case
}

/// Number of the beat that a unit gives for a secondary pixel, by its place on the display.
pub fn output_number(target: Target, recording: &Recording, x: u32, y: u32) -> Option<u64> {
    let table = |unit: Unit| recording.outputs.get(&unit);
    let at = |row: &[u64]| row[0] == u64::from(x) && row[1] == u64::from(y);
    let (place, xs, ys) =
        (table(Unit::Display)?, table(Unit::XInterpolator)?, table(Unit::YInterpolator)?);
    let ends = |n: &usize| xs.row(*n)[7] | ys.row(*n)[3] == 1;
    let beat = (0..place.len()).filter(ends).find(|&n| at(place.row(n)))?;
    match target {
        Target::Sampler | Target::Filter => Some((0..beat).filter(ends).count() as u64),
        Target::Blend => {
            let requests = recording.streams.get("request")?;
            (0..requests.len()).find(|&n| at(&requests.row(n)[1..])).map(|n| n as u64)
        }
        Target::Redirect => {
            let slots = recording.inputs.get(&Unit::Redirect)?;
            // Fields 9 and 10: the secondary's place.
            (0..slots.len()).find(|&n| at(&slots.row(n)[9..])).map(|n| n as u64)
        }
        _ => Some(beat as u64),
    }
}

/// The case of all that is on a tape.
fn whole(target: Target, job: &Job, name: &str, mut tape: Tape) -> Case {
    let before = job.frames(target == Target::Minimal);
    let mut case = recorded(target, job, name, &tape.take());
    case.memory = Some(Box::new([before, tape.frames().clone()]));
    case
}

/// Options drawn at random among those that the configuration can build.
pub fn options(rng: &mut Rng, config: &Config) -> Options {
    let pick = |rng: &mut Rng, n: usize| rng.usize(..n);
    Options {
        cost_rule: rng.u32(..4) == 0,
        specular: if config.integrated && rng.bool() {
            Specular::Integrated
        } else {
            [Specular::Approximation, Specular::Exception][pick(rng, 2)]
        },
        sampling: [Sampling::Automatic, Sampling::Nearest, Sampling::Average][pick(rng, 3)],
        arrangement: [
            Arrangement::Normal,
            Arrangement::Flipped,
            Arrangement::Interleaved,
            Arrangement::AboveBelow,
            Arrangement::Rotated,
        ][pick(rng, 5)],
        single: rng.u32(..5) == 0,
        minimal: false,
    }
}

/// Polygons of all classes, alpha and convex polygons of more than three corners among them.
pub fn random_polygons(seed: u64, formats: Formats, size: [u32; 2], count: u32) -> Vec<Polygon> {
    let mut triangles = Triangles::new(seed, formats, size[0], size[1]);
    (0..count)
        .map(|id| {
            let class = Class::ALL[triangles.rng.usize(..Class::ALL.len())];
            let mut polygon = triangles.triangle(class);
            if triangles.rng.u32(..8) == 0 {
                polygon = triangles.convex();
            }
            if triangles.rng.u32(..4) == 0 {
                let alpha = triangles.rng.u8(..);
                polygon
                    .vertices
                    .iter_mut()
                    .for_each(|v| v.colour.iter_mut().for_each(|c| c.0[3] = alpha));
            }
            Polygon { id, ..polygon }
        })
        .collect()
}

/// Small polygons one after another in the same place, for either eye first: a slot that is still in
/// the queue holds the place that the next one reads.
pub fn crowd(seed: u64, formats: Formats, size: [u32; 2], count: u32) -> Vec<Polygon> {
    let mut triangles = Triangles::new(seed, formats, size[0], size[1]);
    let mut place = Polygon::default();
    let polygon = |id| {
        if id % 8 == 0 {
            let class = [Class::Px2, Class::Px8][triangles.rng.usize(..2)];
            place = triangles.triangle(class);
        }
        let mut polygon = Polygon { id, ..place.clone() };
        let rng = &mut triangles.rng;
        let (swap, colour) = (rng.bool(), rng.u32(..));
        // Few depths, so that some are equal and some differ by one.
        let depth = DEPTH_MAX / 2 + rng.u32(..4);
        if rng.u32(..4) == 0 {
            polygon.eyes = Eyes::One(Eye::BOTH[rng.usize(..2)]);
        }
        for vertex in &mut polygon.vertices {
            if swap {
                vertex.x.swap(0, 1);
            }
            (vertex.depth, vertex.colour) = (depth, [Rgba::from_word(colour); 2]);
        }
        polygon
    };
    (0..count).map(polygon).collect()
}

/// Random polygons in a small window, so that they overlap: about `beats` beats.
pub fn random(target: Target, config: &Config, seed: u64, beats: usize) -> Case {
    let (nothing, tape) = random_tape(config, seed, beats, target == Target::Minimal);
    whole(target, &nothing, "random polygons", tape)
}

/// A tape of random polygons, and a job without them.
pub fn random_tape(
    config: &Config,
    seed: u64,
    beats: usize,
    minimal: bool,
) -> (Job<'static>, Tape) {
    let f = Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let crowded = rng.u32(..4) == 0;
    let size = match crowded {
        true => [rng.u32(4..24), rng.u32(4..24)],
        false => [rng.u32(24..120), rng.u32(16..90)],
    };
    let options = options(rng, config);
    let nothing = job(config, options, size, &[]);
    let mut tape = Tape::new(&nothing, minimal, false);
    let mut drawn = 0;
    for _ in 0..beats {
        let mut polygons = match crowded {
            true => crowd(rng.u64(..), f, size, 64),
            false => random_polygons(rng.u64(..), f, size, 16),
        };
        if config.tilt {
            polygons.iter_mut().for_each(|polygon| tilt(polygon, rng));
        }
        drawn += job(config, options, size, &polygons).run(minimal, tape.sink()).beats();
        if drawn >= beats as u64 {
            break;
        }
    }
    (nothing, tape)
}

/// Shears the right eye's view up or down by at most a pixel a column, as a tilted head does; leaves
/// some polygons upright.
fn tilt(polygon: &mut Polygon, rng: &mut Rng) {
    let slant = [0, 0, 256, -256, rng.i32(-256..=256), rng.i32(-40..=40)][rng.usize(..6)];
    let origin = polygon.vertices[0].x[0];
    for vertex in &mut polygon.vertices {
        vertex.y[1] += (vertex.x[0] - origin) * slant / 256;
    }
}

pub fn job<'a>(
    config: &Config,
    options: Options,
    size: [u32; 2],
    polygons: &'a [Polygon],
) -> Job<'a> {
    Job {
        config: *config,
        options,
        width: size[0],
        height: size[1],
        background: [30, 60, 90],
        scissor: Scissor::default(),
        polygons,
        textures: &[],
        lookup: Lookup::Nearest,
    }
}

/// The case of a job that is drawn as it is.
fn simply(target: Target, job: &Job, name: &str) -> Case {
    let minimal = target == Target::Minimal;
    let mut tape = Tape::new(job, minimal, false);
    job.run(minimal, tape.sink());
    whole(target, job, name, tape)
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

/// Gives each polygon another depth, nearer than those before it: where they are in one place, all are seen.
fn at_depths(first: u32, polygons: impl IntoIterator<Item = Polygon>) -> Vec<Polygon> {
    let nearer = |(n, mut polygon): (u32, Polygon)| {
        polygon.vertices.iter_mut().for_each(|vertex| vertex.depth = first - 1_000 * n);
        Polygon { id: n, ..polygon }
    };
    (0..).zip(polygons).map(nearer).collect()
}

/// `times` each: polygons derived for either eye, one with more edges than the primary pipeline has, for one eye
/// (the minimal system has none to lend), and a triangle for the other. Each draws pixels in some rows, in
/// one part, so that every second one is spoilt.
fn spoilable(minimal: bool, times: usize, f: &Formats) -> Vec<Polygon> {
    const TRIANGLE: &[[i32; 2]] = &[[2, 1], [9, 1], [2, 8]];
    const HEXAGON: &[[i32; 2]] = &[[4, 1], [8, 1], [10, 4], [8, 7], [4, 7], [2, 4]];
    let polygon = |corners: &[[i32; 2]], eyes, wider: Option<Eye>| {
        let vertex = |(n, &[x, y]): (u8, &[i32; 2])| {
            let mut xs = [x << f.subpixel_bits; 2];
            if let Some(eye) = wider {
                xs[eye as usize] += (x - 2) << (f.subpixel_bits - 1);
            }
            let colour = [Rgba([40 * n, 200, 90, 255]); 2];
            Vertex { x: xs, y: [y << f.subpixel_bits; 2], colour, ..Vertex::default() }
        };
        Polygon { vertices: (0..).zip(corners).map(vertex).collect(), eyes, ..Polygon::default() }
    };
    let many = if minimal { TRIANGLE } else { HEXAGON };
    let kinds = [
        polygon(TRIANGLE, Eyes::Both, Some(Eye::Left)),
        polygon(TRIANGLE, Eyes::Both, Some(Eye::Right)),
        polygon(many, Eyes::One(Eye::Left), None),
        polygon(TRIANGLE, Eyes::One(Eye::Right), None),
    ];
    kinds.into_iter().flat_map(|kind| vec![kind; times]).collect()
}

/// Arrangements in which a view's columns and rows run either way, along either side of the display.
const PLACES: [(&str, Arrangement); 3] = [
    ("", Arrangement::Normal),
    (", flipped", Arrangement::Flipped),
    (", rotated", Arrangement::Rotated),
];

/// A view that is as wide or as high as it can be, with small polygons all over it.
pub struct Large {
    /// What it is.
    pub name: String,
    /// Width and height.
    pub size: [u32; 2],
    /// Polygons are derived, though that saves nothing.
    pub options: Options,
    /// The polygons.
    pub polygons: Vec<Polygon>,
}

/// Large views, so that every bit of width and height is 0 in one and 1 in another.
pub fn largest(config: &Config) -> Vec<Large> {
    let f = Formats::new(config);
    let sizes = [[f.max_size, 12], [f.max_size - 1, 19]].into_iter();
    let sizes = sizes.flat_map(|[a, b]| [[a, b], [b, a]]);
    let of = |(size, (place, arrangement)): ([u32; 2], (&str, Arrangement))| {
        let mut triangles = Triangles::new(8, f, size[0], size[1]);
        Large {
            name: format!("a view of {} × {}{place}", size[0], size[1]),
            size,
            options: Options { arrangement, cost_rule: false, ..Options::new(config) },
            polygons: (0..200).map(|id| Polygon { id, ..triangles.triangle(Class::Px2) }).collect(),
        }
    };
    sizes.flat_map(|size| PLACES.map(|place| (size, place))).map(of).collect()
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

/// Its polygons.
fn kinds(f: &Formats) -> Vec<Polygon> {
    let mut polygons = Vec::new();
    for eye in Eye::BOTH {
        for stretch in [1.0, 1.6, 5.0, 20.0] {
            for heights in HEIGHTS {
                let both = [false, true].map(|turn| stretched(eye, stretch, heights, turn, f));
                polygons.extend(both);
            }
        }
        let alone = stretched(eye, 1.6, HEIGHTS[0], false, f);
        polygons.push(Polygon { eyes: Eyes::One(eye), ..alone });
    }
    for (id, polygon) in (0..).zip(&mut polygons) {
        polygon.id = id;
    }
    polygons
}

/// Heights of three corners in half pixels: in every order, two of them equal or none.
const HEIGHTS: [[i32; 3]; 12] = [
    [0, 2, 4],
    [0, 4, 2],
    [2, 0, 4],
    [2, 4, 0],
    [4, 0, 2],
    [4, 2, 0],
    [0, 3, 3],
    [3, 0, 3],
    [3, 3, 0],
    [3, 0, 0],
    [0, 3, 0],
    [0, 0, 3],
];

/// A triangle with corners at these heights, in either winding, whose pixels `eye` sees stretched by a
/// factor.
fn stretched(eye: Eye, stretch: f64, heights: [i32; 3], turn: bool, f: &Formats) -> Polygon {
    let pixel = 1 << f.subpixel_bits;
    // With ratio 1 the left eye is primary unless its view is narrower, by so little that it is still 1.
    let narrower = stretch == 1.0 && eye == Eye::Right;
    let (width, less) = if narrower { (160, 1) } else { (3, 0) };
    // The third corner is above or below one of the others.
    let far = [false, true, heights[2] == heights[0]];
    let vertices = (0..3).map(|n| {
        let across = if far[n] != turn { width * pixel } else { 0 };
        let mut x = [2 * pixel + if across > 0 { across - less } else { 0 }; 2];
        x[eye as usize] = 2 * pixel + (f64::from(across) * stretch) as i32;
        let colour = [Rgba([40 * n as u8, 200, 90, 255]); 2];
        let y = [pixel + heights[n] * pixel / 2; 2];
        Vertex { x, y, depth: 1000, colour, ..Vertex::default() }
    });
    Polygon { vertices: vertices.collect(), ..Polygon::default() }
}

/// A polygon within the rows of the left eye's view that the right eye sees six pixels higher or
/// lower.
fn raised(polygon: &Polygon, f: Formats, height: u32) -> Polygon {
    let mut polygon = polygon.clone();
    let (bottom, shift) = (i64::from(height) * f.one_pixel(), 6 * f.one_pixel());
    let shift = if polygon.id.is_multiple_of(2) { shift } else { -shift };
    for vertex in &mut polygon.vertices {
        let y = i64::from(vertex.y[0]).clamp(0, bottom);
        vertex.y = [y, y + shift].map(|y| y as i32);
    }
    polygon
}

/// Passes polygons on, every second one with its setup spoilt, or put just inside what is allowed.
struct Spoiler<'a, S> {
    sink: &'a mut S,
    formats: Formats,
    polygon: usize,
    /// Ways of spoiling: the last one is a beat's, the others are a record's.
    ways: usize,
}

impl<S> Spoiler<'_, S> {
    /// How the present polygon is treated.
    fn way(&self) -> usize {
        if self.polygon.is_multiple_of(2) {
            self.polygon / 2 % self.ways
        } else {
            12
        }
    }
}

impl<S: Sink> Sink for Spoiler<'_, S> {
    fn polygon(&mut self, id: u32) {
        self.polygon += 1;
        self.sink.polygon(id);
    }
    fn walk(&mut self, walk: &Walk, planes: &Planes) {
        self.sink.walk(walk, planes);
    }
    fn records(&mut self, setup: &Setup, edges: &Edges) {
        let f = &self.formats;
        let first = -(i64::from(f.guard_band) + START_SLACK) << FRACTION_BITS;
        let end = (i64::from(f.max_size) << FRACTION_BITS) - first;
        let step = |step: i64| Setup { x_step: Scale::new(step, f), ..*setup };
        let start = |start: i64| Setup { x_start: SecondaryX::new(start, f), ..*setup };
        let treated = match self.way() {
            0 => Setup { mode: Mode(4 + setup.mode.0), ..*setup },
            1 => step(SCALE_ONE + 1),
            2 => step(SCALE_ONE),
            3 => step(SCALE_MIN - 1),
            4 => step(SCALE_MIN),
            5 => start(first - 1),
            6 => start(first),
            7 => start(end),
            8 => start(end - 1),
            9 => Setup { lend: true, ..*setup },
            _ => *setup,
        };
        let empty = Edges {
            e0_a: Slope::default(),
            e1_a: Slope::default(),
            e2_a: Slope::default(),
            ..*edges
        };
        let edges = if self.way() == 10 { &empty } else { edges };
        self.sink.records(&treated, edges);
    }
    fn beat(&mut self, beat: &PrimaryBeat) {
        let illegal = self.way() == 11 && beat.op == Op::Row;
        let op = if illegal { Op::Reserved } else { beat.op };
        self.sink.beat(&PrimaryBeat { op, ..*beat });
    }
}
