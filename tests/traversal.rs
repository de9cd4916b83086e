//! Traversal: the rows that setup found with divisions are those that signs of edge functions end.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats, Quantity};
use wheatstone_golden::pipeline::traversal::{traverse, Visit};
use wheatstone_golden::pipeline::Op;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::setup::*;

const SIZE: [u32; 2] = [160, 120];

/// The rows of a part, in display order, as the traversal ends them.
fn visited(part: &Part, registers: &PrimaryRegisters, f: &Formats) -> Vec<[i64; 3]> {
    let edges = registers.view.edges();
    let (walk, _) = registers.records(part, [edges[0], edges[1], edges[2]], true, f);
    let mut rows: Vec<[i64; 3]> = Vec::new();
    let mut lasts = 0;
    traverse(&walk, f, |visit: &Visit| {
        let (x, y) = (visit.x.raw(), visit.y.raw());
        match (visit.op, rows.last_mut()) {
            (Op::Step, Some(row)) => row[2] = x,
            _ => rows.push([y, x, x]),
        }
        if let (true, Some(row)) = (visit.save, rows.last_mut()) {
            row[1] = x;
        }
        lasts += i32::from(visit.last);
    });
    assert_eq!(lasts, 1, "one pixel is the last");
    rows
}

#[test]
fn rows_begin_and_end_where_division_says() {
    let mut rows_seen = 0;
    for config in [Config::DEFAULT, Config::PAPER, Config::FULL] {
        let f = Formats::new(&config);
        let planner = Planner::new(config, Options::new(&config), SIZE[0], SIZE[1]);
        for (seed, class) in Class::ALL.into_iter().enumerate() {
            let mut triangles = Triangles::new(seed as u64, f, SIZE[0], SIZE[1]);
            for n in 0..300 {
                let polygon = triangles.triangle(class);
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
                registers.parts(
                    &rows,
                    |_| true,
                    |part| {
                        let expected: Vec<[i64; 3]> = part
                            .rows
                            .iter()
                            .map(|r| [r.y, r.first, r.last].map(i64::from))
                            .collect();
                        assert_eq!(visited(part, &registers, &f), expected, "{polygon:?}");
                        rows_seen += expected.len();
                    },
                );
            }
        }
    }
    assert!(rows_seen > 50_000, "{rows_seen}");
}
