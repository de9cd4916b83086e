//! Y interpolator: every arrangement of the displays against its definition, and the tilted y against
//! exact fractions.

mod walk;

use walk::{each_derived, exact, walk};
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::display::{display, DisplayPoint};
use wheatstone_golden::pipeline::y_interpolator::{YBeat, YInterpolator, YPixel};
use wheatstone_golden::pipeline::{Lookahead, Op, Setup};
use wheatstone_golden::random::Class;
use wheatstone_golden::setup::{Arrangement, Derived, Options, Planner, Polygon};

/// The pixels of a derived polygon's beats.
fn run(planner: &Planner, walk: &walk::Walk) -> Vec<YPixel> {
    let mut model = YInterpolator::new(planner.formats, planner.config.tilt, planner.height);
    let mut waiting = None;
    let mut pixels = Vec::new();
    for b in &walk.beats {
        let (setup, _) = &walk.records[b.part];
        let beat = YBeat {
            op: b.op,
            save: b.save,
            last: b.last,
            start: setup.y_start,
            step: setup.y_step,
            view: setup.y_view,
            slant: setup.y_slant,
            row: setup.y_row,
        };
        let complete = model.step(&beat).follow(&mut waiting);
        pixels.extend(complete.into_iter().flatten().map(|state| state.pixel));
    }
    assert_eq!(pixels.len(), walk.beats.len(), "the last beat completes its own pixel");
    pixels
}

/// Position of view pixel (x, y) in an arrangement, by definition.
fn shown(
    arrangement: Arrangement,
    eye: Eye,
    [x, y]: [i64; 2],
    [width, height]: [i64; 2],
) -> [i64; 2] {
    let right = eye == Eye::Right;
    match arrangement {
        Arrangement::Normal => [x, y],
        Arrangement::Flipped => [x, height - 1 - y],
        Arrangement::Interleaved => [x, 2 * y + i64::from(right)],
        Arrangement::AboveBelow => [x, if right { height + y } else { y }],
        // A quarter turn anticlockwise takes the right end of a row to the top of a column.
        Arrangement::Rotated if right => [y, width - 1 - x],
        Arrangement::Rotated => [height - 1 - y, x],
    }
}

#[test]
fn every_arrangement_shows_pixels_where_its_definition_says() {
    let config = Config::DEFAULT;
    let size = [160, 100];
    for arrangement in [
        Arrangement::Normal,
        Arrangement::Flipped,
        Arrangement::Interleaved,
        Arrangement::AboveBelow,
        Arrangement::Rotated,
    ] {
        let options = Options { arrangement, ..Options::new(&config) };
        let mut eyes = [0; 2];
        let check = |planner: &Planner, polygon: &Polygon, derived: &Derived| {
            let secondary = derived.primary.other();
            eyes[secondary as usize] += 1;
            let walk = walk(planner, polygon, derived);
            let pixels = run(planner, &walk);
            for (n, (pixel, b)) in pixels.iter().zip(&walk.beats).enumerate() {
                let setup: &Setup = &walk.records[b.part].0;
                assert!(pixel.inside && pixel.r#move.raw() == 0);
                let next = walk.beats.get(n + 1).map(|next| next.op);
                assert_eq!(pixel.end, next != Some(Op::Step));
                for x in [0, 1, 77, 159] {
                    let point = DisplayPoint {
                        x: PixelX::new(x, &planner.formats),
                        y: pixel.y,
                        swap: setup.swap,
                        mirror: setup.mirror,
                    };
                    let place = display(&point, planner.width, &planner.formats);
                    let expected = shown(arrangement, secondary, [x, b.at[1]], [160, 100]);
                    assert_eq!([place.x.raw(), place.y.raw()], expected, "{arrangement:?}");
                }
            }
        };
        each_derived(&config, options, size, &Class::ALL, 15, check);
        assert!(eyes[0] > 20 && eyes[1] > 20, "{eyes:?}");
    }
}

#[test]
fn a_tilted_y_follows_the_map_within_the_error_bound() {
    let config = Config { antialias: false, ..Config::FULL };
    let mut moved = [0u32; 3];
    each_derived(
        &config,
        Options::new(&config),
        [200, 150],
        &Class::ALL,
        40,
        |planner, level, _| {
            // Turn the head: each vertex of the right view moves by a part of its disparity, up or down.
            let mut polygon = level.clone();
            let part = if level.vertices[0].depth % 2 == 0 { 4 } else { -4 };
            for vertex in &mut polygon.vertices {
                vertex.y[1] += (vertex.x[0] - vertex.x[1]) / part;
            }
            let plan = planner.plan(&polygon);
            let wheatstone_golden::setup::Plan::Derived(derived) = plan else { return };
            let f = &planner.formats;
            let walk = walk(planner, &polygon, &derived);
            let pixels = run(planner, &walk);
            let position = |n: usize| {
                let b = &walk.beats[n];
                let setup = &walk.records[b.part].0;
                setup.y_view.raw() + b.rows * setup.y_row.raw() + b.steps * setup.y_slant.raw()
            };
            let mut row_start = 0;
            for (n, (pixel, b)) in pixels.iter().zip(&walk.beats).enumerate() {
                let setup = &walk.records[b.part].0;
                let raw = position(n);
                let v = raw >> FRACTION_BITS;
                let y = setup.y_start.raw() + setup.y_step.raw() * v;
                assert_eq!(pixel.y, Coordinate::wrap(y, f));
                assert_eq!(pixel.inside, (0..150).contains(&v));
                let movement = match b.op {
                    Op::Load => 0,
                    Op::Row => v - row_start - (setup.y_row.raw() >> FRACTION_BITS),
                    _ => v - (position(n - 1) >> FRACTION_BITS),
                };
                assert_eq!(pixel.r#move.raw(), movement, "beat {n} {b:?} of {polygon:?}");
                moved[(movement + 1) as usize] += 1;
                let goes_on = walk.beats.get(n + 1).is_some_and(|next| {
                    next.op == Op::Step && position(n + 1) >> FRACTION_BITS == v
                });
                assert_eq!(pixel.end, !goes_on);
                if b.save {
                    row_start = v;
                }
                let [_, exact] = exact(&polygon, derived.primary, b.at, f);
                assert!(exact.is_near(raw, 1 + b.rows + b.steps), "beat {n} {b:?} of {polygon:?}");
            }
        },
    );
    assert!(moved.iter().all(|&count| count > 100), "movements -1, 0, 1: {moved:?}");
}

#[test]
fn a_row_moves_by_the_carry_of_the_fractions() {
    let f = Formats::new(&Config::FULL);
    let one = 1 << FRACTION_BITS;
    for view in [0, 1, one / 2, one - 2, one - 1, 5 * one + 3] {
        for row in [0, 1, one / 2 - 1, one / 2, one - 2, one - 1, -1, -one, -one - 1, 3 - one] {
            let mut model = YInterpolator::new(f, true, 150);
            let [view, row] = [view, row].map(|raw| SecondaryX::new(raw, &f));
            let load = YBeat { op: Op::Load, save: true, view, row, ..YBeat::default() };
            model.step(&load);
            let moved = model.step(&YBeat { op: Op::Row, ..load }).pixel.r#move.raw();
            let whole = |raw: i64| raw.div_euclid(one);
            let carried = whole(view.raw() + row.raw()) - whole(view.raw()) - whole(row.raw());
            assert_eq!(moved, carried, "{view:?} {row:?}");
        }
    }
}
