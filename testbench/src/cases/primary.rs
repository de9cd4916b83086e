//! Cases of the primary pipeline, of its traversal, and of the monocular pipeline.

use super::case::Case;
use super::{polygons, shapes};
use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::frame::Frames;
use wheatstone_golden::interface::{Beat, Table};
use wheatstone_golden::pipeline::mono::Mono;
use wheatstone_golden::pipeline::primary::Primary;
use wheatstone_golden::pipeline::traversal::{traverse, Visit};
use wheatstone_golden::pipeline::{Output, Pixel, Planes, Request, Response, Walk};
use wheatstone_golden::record::{Recording, Tape};
use wheatstone_golden::setup::{Eyes, Options, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;

/// The case of the records that a recording has.
pub fn recorded(target: Target, job: &Job, name: &str, recording: &Recording) -> Case {
    let all = records(recording, &job.config);
    if target == Target::Mono {
        return drawn(job, name, Eye::Left, &all);
    }
    of(target, &job.config, name, job.width, &all)
}

/// The records that a recording has.
fn records(recording: &Recording, config: &Config) -> Vec<(Walk, Planes)> {
    let f = Formats::new(config);
    let [walks, planes] = ["walk", "planes"].map(|stream| &recording.streams[stream]);
    (0..walks.len()).map(|n| (read(walks.row(n), &f), read(planes.row(n), &f))).collect()
}

/// The beat of a table's row.
fn read<B: Beat>(row: &[u64], f: &Formats) -> B {
    let fields = B::fields(f);
    let numbers = fields.iter().zip(row).map(|(field, &bits)| field.number(bits) as u64);
    B::read(&numbers.collect::<Vec<_>>())
}

/// The case that the models make of records.
fn of(target: Target, config: &Config, name: &str, width: u32, records: &[(Walk, Planes)]) -> Case {
    let f = Formats::new(config);
    let mut case = Case::empty(target, config, name);
    for (walk, _) in records {
        case.inputs[0].push(walk);
    }
    if target == Target::Traversal {
        for (walk, _) in records {
            traverse(walk, &f, |visit: &Visit| case.outputs[0].push(visit));
        }
        return case;
    }
    case.statics = vec![width.into()];
    let mut primary = Primary::new(config, width);
    for (walk, planes) in records {
        case.inputs[1].push(planes);
        primary.part(walk, planes, |beat| case.outputs[0].push(beat));
    }
    case
}

/// Random polygons, and between them records without sense: the ends of rows may be anywhere.
pub fn random(target: Target, config: &Config, seed: u64, beats: usize) -> Case {
    let (width, records) = random_records(config, seed, beats);
    of(target, config, "random polygons", width, &records)
}

/// The case of a pack: random polygons, then the corners of the number range, but for parts of very many rows.
pub fn for_pack(target: Target, config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let (width, mut records) = random_records(config, seed, beats);
    records.extend(corner_records(f));
    records.extend(barely_whole(f));
    of(target, config, "random polygons", width, &records)
}

/// Records of random polygons, and the width of their view.
fn random_records(config: &Config, seed: u64, beats: usize) -> (u32, Vec<(Walk, Planes)>) {
    let (f, rng) = (Formats::new(config), &mut Rng::with_seed(seed));
    let (job, mut tape) = polygons::random_tape(config, seed, beats, false);
    let recording = tape.take();
    let [walks, planes] = ["walk", "planes"].map(|stream| &recording.streams[stream]);
    let mut all = Vec::new();
    for record in records(&recording, config) {
        all.push(record);
        if rng.u32(..16) == 0 {
            all.push(senseless(rng, walks, planes, &f));
        }
    }
    (job.width, all)
}

/// A record whose every register is that of some record in the tables, or anything; small enough that
/// it ends soon.
fn senseless(rng: &mut Rng, walks: &Table, planes: &Table, f: &Formats) -> (Walk, Planes) {
    let (walk, planes) = (mixed::<Walk>(rng, walks, f), mixed::<Planes>(rng, planes, f));
    // A row ends at the latest where the column comes to `right`.
    let right = walk.x.raw() + rng.i64(0..40);
    let walk = Walk {
        rows: Coordinate::new(rng.i64(0..4), f),
        x_row: PixelX::new(rng.i64(-3..4), f),
        right: PixelX::wrap(right, f),
        ..walk
    };
    (walk, planes)
}

fn mixed<B: Beat>(rng: &mut Rng, table: &Table, f: &Formats) -> B {
    let mut field = |n: usize| match rng.u32(..8) {
        0 => rng.u64(..),
        _ => table.row(rng.usize(..table.len()))[n],
    };
    let row: Vec<u64> = (0..table.width()).map(&mut field).collect();
    read(&row, f)
}

/// Corners of the number range: flat and vertical edges, rows of one pixel, both ends of the columns,
/// parts of as many rows as there can be.
pub fn corners(target: Target, config: &Config) -> Case {
    let f = &Formats::new(config);
    let mut records = corner_records(f);
    // Columns of pixels: every bit of the number of rows is 1 in one of them, and 0 in another.
    let most = i64::from(f.max_size) - 1;
    for rows in [most, most / 2 + 1, 0x555 & most, 0x2aa & most] {
        let walk = Walk {
            rows: Coordinate::new(rows, f),
            x: PixelX::new(9, f),
            left: PixelX::new(9, f),
            right: PixelX::new(9, f),
            y_step: DisplayStep::new(1, f),
            ..Walk::default()
        };
        records.push((walk, Planes::default()));
    }
    records.extend(barely_whole(f));
    let name = "flat and steep edges, both ends of the columns, many rows, barely whole planes";
    of(target, config, name, 6, &records)
}

/// Flat and vertical edges, rows of one pixel, both ends of the columns.
fn corner_records(f: &Formats) -> Vec<(Walk, Planes)> {
    let mut records = Vec::new();
    let (leftmost, end) = (-(1 << (PixelX::bits(f) - 1)), (1 << (PixelX::bits(f) - 1)));
    for creep in [false, true] {
        for (x, x_row) in [(0, 0), (leftmost + 8, -2), (end - 9, 1), (5, 2)] {
            for a in [0, 1, -1, 300, -300] {
                for (bound, start) in [(0, 0), (1, -1), (0, 5), (-40, 40), (a, 0)] {
                    let edge = |a: i64| {
                        (
                            EdgeValue::wrap(start * a.signum().max(1), f),
                            Slope::new(a, f),
                            EdgeValue::wrap(a * (x_row + 1) + 7, f),
                        )
                    };
                    let (e0_start, e0_a, e0_row) = edge(a);
                    let (e1_start, e1_a, e1_row) = edge(-a * 2);
                    let bound = Bound::new(bound, f);
                    let value = 1 << 38 | start << 20;
                    let colour = (1 << 23) - (1 << 20) * start;
                    records.push((
                        Walk {
                            last: start == 5,
                            creep,
                            rows: Coordinate::new(3, f),
                            x: PixelX::new(x, f),
                            x_row: PixelX::new(x_row, f),
                            left: PixelX::new((x - 1).max(leftmost), f),
                            right: PixelX::new((x + 6).min(end - 1), f),
                            y: Coordinate::new(6, f),
                            y_step: DisplayStep::new([1, -1, 2][(start + 40) as usize % 3], f),
                            swap: start == -1,
                            mirror: start == 40,
                            e0_start,
                            e0_a,
                            e0_row,
                            e0_bound: bound,
                            e0_b: Slope::new(9, f),
                            e0_low: LowBits::new(5, f),
                            e1_start,
                            e1_a,
                            e1_row,
                            e1_bound: bound,
                            e1_b: Slope::new(-70, f),
                            e1_low: LowBits::new(2, f),
                            ..Walk::default()
                        },
                        Planes {
                            z_start: DepthPlane::wrap(value, f),
                            z_a: DepthPlane::wrap(-value / 2, f),
                            z_row: DepthPlane::wrap(value / 3, f),
                            red_start: ColourPlane::wrap(colour, f),
                            red_a: ColourPlane::wrap(-colour / 2, f),
                            green_start: ColourPlane::wrap(-colour, f),
                            green_a: ColourPlane::wrap(colour / 2, f),
                            blue_row: ColourPlane::wrap(colour / 3, f),
                            blue_a: ColourPlane::wrap(1 << 14, f),
                            alpha_start: ColourPlane::wrap(255 << 14, f),
                            alpha_a: ColourPlane::wrap(1 << 13, f),
                            alpha_row: ColourPlane::wrap(-(1 << 14), f),
                            ..Planes::default()
                        },
                    ));
                }
            }
        }
    }
    records
}

/// Planes that are a whole number after a step and after a row, in which one bit of the fraction was 1 before:
/// where it gets lost, or comes from nowhere, the number is another one. Each part is in front of those before it.
fn barely_whole(f: &Formats) -> Vec<(Walk, Planes)> {
    // An even and an odd number of steps in a row: what changes and changes back shows in one of them. Rows begin
    // at the least movement, or a pixel further.
    let ways = [(4, false), (5, false), (4, true), (5, true)];
    let parts = (0..FRACTION_BITS).flat_map(|bit| ways.map(|(right, moves)| (bit, right, moves)));
    parts.zip(0..).map(|((bit, right, moves), n)| barely(bit, right, moves, n, f)).collect()
}

fn barely(bit: u32, right: i64, moves: bool, n: i64, f: &Formats) -> (Walk, Planes) {
    let low = 1i64 << bit;
    let colour = |whole: i64| ColourPlane::new((whole << FRACTION_BITS) + low, f);
    let back = ColourPlane::new(-low, f);
    let (x_row, down) = if moves { (-1, 0) } else { (0, -low) };
    let row = ColourPlane::new(down, f);
    let walk = Walk {
        rows: Coordinate::new(3, f),
        x: PixelX::new(2, f),
        x_row: PixelX::new(x_row, f),
        left: PixelX::new(2, f),
        right: PixelX::new(right, f),
        y_step: DisplayStep::new(1, f),
        ..Walk::default()
    };
    let planes = Planes {
        z_start: DepthPlane::new(((90_000 - 8 * n) << FRACTION_BITS) + low, f),
        z_a: DepthPlane::new(-low, f),
        z_row: DepthPlane::new(down, f),
        red_start: colour(17),
        red_a: back,
        red_row: row,
        green_start: colour(100),
        green_a: back,
        green_row: row,
        blue_start: colour(200),
        blue_a: back,
        blue_row: row,
        alpha_start: colour(129),
        alpha_a: back,
        alpha_row: row,
    };
    (walk, planes)
}

/// Frame buffers that note what passes to and from them.
struct Noted {
    frames: Frames,
    case: Case,
}

impl Output for Noted {
    fn read(&mut self, request: &Request) -> Response {
        let response = self.frames.read(request);
        self.case.outputs[0].push(request);
        self.case.inputs[2].push(&response);
        response
    }
    fn write(&mut self, eye: Eye, pixel: &Pixel) {
        self.frames.write(eye, pixel);
        self.case.outputs[1].push(pixel);
    }
}

/// The case of records that the monocular pipeline draws for an eye.
fn drawn(job: &Job, name: &str, eye: Eye, records: &[(Walk, Planes)]) -> Case {
    let mut case = Case::empty(Target::Mono, &job.config, name);
    case.statics = vec![job.width.into(), eye as u64];
    let before = job.frames(false);
    let mut noted = Noted { frames: before.clone(), case };
    let mut mono = Mono::new(&job.config, job.width, eye);
    for (walk, planes) in records {
        noted.case.inputs[0].push(walk);
        noted.case.inputs[1].push(planes);
        mono.part(walk, planes, &mut noted);
    }
    Case { memory: Some(Box::new([before, noted.frames])), ..noted.case }
}

/// The case of a job's polygons that one eye sees, those with more than three corners in triangles.
pub fn monocular(job: &Job, eye: Eye, name: &str) -> Case {
    let seen = job.polygons.iter().filter(|p| p.eyes == Eyes::Both || p.eyes == Eyes::One(eye));
    let triangles = seen.flat_map(Polygon::fan);
    let triangles = triangles.map(|polygon| Polygon { eyes: Eyes::One(eye), ..polygon });
    let triangles: Vec<Polygon> = triangles.collect();
    let job = Job { polygons: &triangles, ..Target::Mono.job(job) };
    let mut tape = Tape::new(&job, false, false);
    job.run(false, tape.sink());
    drawn(&job, name, eye, &records(&tape.take(), &job.config))
}

fn for_one_eye(polygons: Vec<Polygon>, eye: Eye) -> Vec<Polygon> {
    polygons.into_iter().map(|polygon| Polygon { eyes: Eyes::One(eye), ..polygon }).collect()
}

/// Random polygons for a random eye, in a window so small that they overlap.
pub fn mono_random(config: &Config, seed: u64, beats: usize) -> Case {
    let (f, rng) = (Formats::new(config), &mut Rng::with_seed(seed));
    let size = [rng.u32(24..90), rng.u32(16..70)];
    let (seed, eye) = (rng.u64(..), Eye::BOTH[rng.usize(..2)]);
    let options = polygons::options(rng, config);
    let of = |count| {
        let polygons = for_one_eye(polygons::random_polygons(seed, f, size, count), eye);
        monocular(&polygons::job(config, options, size, &polygons), eye, "random polygons")
    };
    // Of few, none may have a pixel: then of twice as many.
    let counts = (0..10).map(|n| ((beats / 150).max(2) as u32) << n);
    let is_drawn = |case: &Case| case.outputs.iter().any(|table| !table.is_empty());
    counts.map(of).find(is_drawn).unwrap_or_else(|| of(0))
}

/// The case of a pack for an eye: random polygons, then some on top of each other, then planes that are barely
/// whole numbers.
pub fn mono_for_pack(config: &Config, seed: u64, beats: usize, eye: Eye) -> Case {
    let (f, rng) = (Formats::new(config), &mut Rng::with_seed(seed));
    let size = [rng.u32(24..90), rng.u32(16..70)];
    let polygons = polygons::random_polygons(rng.u64(..), f, size, (beats / 150).max(2) as u32);
    let crowd = polygons::crowd(rng.u64(..), f, [12, 8], 48);
    let mut all = Vec::new();
    let nothing = polygons::job(config, polygons::options(rng, config), size, &[]);
    for polygons in [polygons, crowd] {
        let triangles = polygons.iter().flat_map(Polygon::fan).collect();
        let triangles = for_one_eye(triangles, eye);
        let job = Job { polygons: &triangles, ..nothing.clone() };
        let mut tape = Tape::new(&job, false, false);
        job.run(false, tape.sink());
        all.extend(records(&tape.take(), config));
    }
    all.extend(barely_whole(&f));
    drawn(&nothing, "random polygons", eye, &all)
}

/// Large views, each for one eye.
pub fn mono_large(config: &Config) -> Vec<Case> {
    let draw = |(large, eye): (shapes::Large, Eye)| {
        let shapes::Large { name, size, options, polygons } = large;
        let polygons = for_one_eye(polygons, eye);
        monocular(&polygons::job(config, options, size, &polygons), eye, &name)
    };
    shapes::largest(config).into_iter().zip(Eye::BOTH.into_iter().cycle()).map(draw).collect()
}

/// Small polygons on top of each other: the next one reads what is still in the queue.
pub fn mono_crowd(config: &Config, eye: Eye) -> Case {
    let size = [16, 12];
    let polygons = polygons::crowd(6, Formats::new(config), size, 240);
    let name = format!("polygons on top of each other, {} eye", eye.name());
    let polygons = for_one_eye(polygons, eye);
    monocular(&polygons::job(config, Options::new(config), size, &polygons), eye, &name)
}

/// Planes that are barely whole numbers, for an eye.
pub fn mono_barely_whole(config: &Config, eye: Eye) -> Case {
    let nothing = polygons::job(config, Options::new(config), [16, 12], &[]);
    let name = format!("barely whole planes, {} eye", eye.name());
    drawn(&nothing, &name, eye, &barely_whole(&Formats::new(config)))
}
