//! Traversal: the rows that setup found with divisions are those that signs of edge functions end, and the
//! edge functions say inside where scan conversion does.

use std::collections::BTreeSet;
use wheatstone_golden::config::Config;
use wheatstone_golden::direct::scan;
use wheatstone_golden::formats::{Eye, Formats, Quantity};
use wheatstone_golden::pipeline::traversal::{traverse, Visit};
use wheatstone_golden::pipeline::Op;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::setup::*;

const SIZE: [u32; 2] = [160, 120];

/// The rows of a part, in display order, as the traversal ends them; the pixels whose three edge functions
/// say that the centre is inside are put with `inside`.
fn visited(
    part: &Part,
    registers: &PrimaryRegisters,
    f: &Formats,
    inside: &mut BTreeSet<[i64; 2]>,
) -> Vec<[i64; 3]> {
    let edges = registers.view.edges();
    let (walk, _) = registers.records(part, [edges[0], edges[1], edges[2]], true, f);
    let mut rows: Vec<[i64; 3]> = Vec::new();
    let (mut starts, mut lasts) = (Vec::new(), 0);
    traverse(&walk, f, |visit: &Visit| {
        let (x, y) = (visit.x.raw(), visit.y.raw());
        match (visit.op, rows.last_mut()) {
            (Op::Step, Some(row)) => row[2] = x,
            _ => {
                rows.push([y, x, x]);
                starts.push(x);
            }
        }
        if let (true, Some(row)) = (visit.save, rows.last_mut()) {
            row[1] = x;
        }
        if [visit.value0, visit.value1, visit.value2].iter().all(|value| value.raw() >= 0) {
            inside.insert([x, y]);
        }
        lasts += i32::from(visit.last);
    });
    assert_eq!(lasts, 1, "one pixel is the last");
    // A row that begins right of the least movement is met a pixel further at once, unless it creeps there.
    for (n, pair) in rows.windows(2).enumerate() {
        let least = pair[0][1] + walk.x_row.raw();
        let further = pair[1][1] > least && !walk.creep;
        assert_eq!(starts[n + 1], least + i64::from(further), "row {n}");
    }
    rows
}

#[test]
fn rows_begin_and_end_where_division_says() {
    let mut rows_seen = 0;
    for config in [Config::DEFAULT, Config::PAPER, Config::FULL] {
        let f = Formats::new(&config);
        let planner = Planner::new(config, Options::new(&config), SIZE[0], SIZE[1]);
        // Scan conversion without samples, which a sliver may miss.
        let centres = Formats::new(&Config { antialias: false, ..config });
        for (seed, class) in Class::ALL.into_iter().enumerate() {
            let mut triangles = Triangles::new(seed as u64, f, SIZE[0], SIZE[1]);
            for n in 0..300 {
                let mut polygon = triangles.triangle(class);
                if n % 4 == 1 {
                    // Across the left end of the view.
                    polygon.vertices.iter_mut().for_each(|v| v.x[0] -= 80 * f.one_pixel() as i32);
                }
                let outline = Outline::new(&polygon, Eye::Left);
                if outline.doubled_area() == 0 {
                    continue;
                }
                let view = View::new(&outline, &f);
                let spans = match n % 3 {
                    0 => view.monocular_spans(SIZE[0]),
                    _ => view.extended_spans(n % 3 * 7 - 7, n % 5 * 64, [-20, 170]),
                };
                let rows: Vec<Row> = view.rows(&spans, SIZE[1]).collect();
                let attributes = Attributes::new(&polygon, Eye::Left, &f);
                let registers =
                    PrimaryRegisters::new(&planner, Eye::Left, view, spans, &attributes);
                let mut inside = BTreeSet::new();
                registers.parts(
                    &rows,
                    |_| true,
                    |part| {
                        let expected: Vec<[i64; 3]> = part
                            .rows
                            .iter()
                            .map(|r| [r.y, r.first, r.last].map(i64::from))
                            .collect();
                        assert_eq!(
                            visited(part, &registers, &f, &mut inside),
                            expected,
                            "{polygon:?}"
                        );
                        rows_seen += expected.len();
                    },
                );
                let mut covered = BTreeSet::new();
                scan(&outline, SIZE, &centres, |x, y, _, _| {
                    covered.insert([x, y]);
                });
                let [width, height] = SIZE.map(i64::from);
                inside.retain(|[x, y]| (0..width).contains(x) && (0..height).contains(y));
                assert_eq!(inside, covered, "{polygon:?}");
            }
        }
    }
    assert!(rows_seen > 50_000, "{rows_seen}");
}
