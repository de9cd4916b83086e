//! Traversals that paint.

use super::part::{hull, Part};
use super::piece::Region;
use super::scan::Scan;
use super::tree::{Node, Tree, NONE};
use crate::cost;
use crate::formats::{Eye, FRACTION_BITS};
use crate::setup::Linear;
use crate::visibility::depths::keep_nearer;
use crate::visibility::scan_line::Line;
use crate::visibility::{Items, Surfaces};
use crate::work::{Meter, Operations};
use std::cmp::Ordering;
use std::ops::Range;

/// Item buffer of one eye, by a traversal for it.
pub fn one(surfaces: &Surfaces, tree: &Tree, eye: Eye, meter: &mut impl Meter) -> Items {
    let mut items = [surfaces.items()];
    draw(surfaces, tree, [eye], &mut items, &mut ZBuffer::default(), meter);
    let [items] = items;
    items
}

/// Item buffers of both eyes, by one traversal.
pub fn both(surfaces: &Surfaces, tree: &Tree, meter: &mut impl Meter) -> [Items; 2] {
    let mut items = [(); 2].map(|()| surfaces.items());
    draw(surfaces, tree, Eye::BOTH, &mut items, &mut ZBuffer::default(), meter);
    items
}

/// Depths of the left view, where the order does not decide.
#[derive(Clone, Debug, Default)]
pub struct ZBuffer(Vec<i32>);

impl ZBuffer {
    /// Clears a part of the buffer of a view.
    fn clear(&mut self, items: &Items, part: &Part) {
        self.0.resize(items.item.len(), i32::MAX);
        for row in part.rows.clone() {
            self.span(items, row, part.columns.clone()).fill(i32::MAX);
        }
    }

    fn span(&mut self, items: &Items, row: i32, columns: Range<i32>) -> &mut [i32] {
        let start = row as usize * items.width as usize;
        &mut self.0[start + columns.start as usize..start + columns.end as usize]
    }

    /// Draws part of a row where it is nearer.
    fn draw(
        &mut self,
        items: &mut Items,
        row: i32,
        columns: Range<i32>,
        depth: &Linear,
        polygon: u32,
    ) {
        const UNIT: f64 = (1 << FRACTION_BITS) as f64;
        let depths = self.span(items, row, columns.clone());
        let first = depth.at(columns.start.into(), row.into());
        let line = Line { first: first as f64 / UNIT, slope: depth.a as f64 / UNIT };
        let columns = columns.start as usize..columns.end as usize;
        keep_nearer(&mut items.row(row)[columns], depths, line, polygon);
    }
}

/// A step of a traversal that is left to do.
#[derive(Clone, Copy)]
enum Task {
    Visit(u32),
    Paint(u32),
    /// The end of what is below a plane between the eyes.
    Agree,
}

/// Paints what some eyes see over item buffers of the surfaces' size, by one traversal in the
/// order of the last of them.
pub fn draw<const EYES: usize>(
    surfaces: &Surfaces,
    tree: &Tree,
    eyes: [Eye; EYES],
    items: &mut [Items; EYES],
    z_buffer: &mut ZBuffer,
    meter: &mut impl Meter,
) {
    items.iter_mut().for_each(Items::clear);
    let mut painter = Painter {
        surfaces,
        eyes,
        canvas: Canvas { items, z_buffer, meter },
        contested: false,
        level: surfaces.level().is_ok(),
        scan: Scan::new(),
        scan_one: Scan::new(),
    };
    let root = if tree.nodes.is_empty() { NONE } else { 0 };
    let mut tasks = vec![Task::Visit(root)];
    while let Some(task) = tasks.pop() {
        match task {
            Task::Visit(NONE) => {}
            Task::Paint(node) => painter.node(&tree.nodes[node as usize]),
            Task::Agree => painter.contested = false,
            Task::Visit(number) => {
                let node = &tree.nodes[number as usize];
                if let (Some(part), false) = (&node.contested, EYES == 1 || painter.contested) {
                    painter.contested = true;
                    painter.canvas.z_buffer.clear(&painter.canvas.items[0], part);
                    tasks.push(Task::Agree);
                }
                let [low, high] = node.sides;
                let [far, near] = match painter.far(node) {
                    Ordering::Greater => [high, low],
                    _ => [low, high],
                };
                // The last one is done first.
                tasks.extend([Task::Visit(near), Task::Paint(number), Task::Visit(far)]);
            }
        }
    }
}

struct Painter<'a, M, const EYES: usize> {
    surfaces: &'a Surfaces<'a>,
    eyes: [Eye; EYES],
    canvas: Canvas<'a, M, EYES>,
    /// True if all but the last view are to be resolved by depth.
    contested: bool,
    /// True if the views share their rows.
    level: bool,
    scan: Scan<EYES>,
    scan_one: Scan<1>,
}

impl<M: Meter, const EYES: usize> Painter<'_, M, EYES> {
    /// The far side of a node for the eye whose order is followed, or for the one that sees
    /// something below it.
    fn far(&self, node: &Node) -> Ordering {
        let far = self.eyes.map(|eye| node.far[eye as usize]);
        far.into_iter().rev().find(|far| far.is_ne()).unwrap_or(Ordering::Equal)
    }

    /// Paints the polygon of a node: in all views at once if all eyes see this piece of it and share
    /// its rows, or else in each that does.
    fn node(&mut self, node: &Node) {
        let Painter { surfaces, eyes, canvas, contested, level, scan, scan_one } = self;
        let regions = eyes.map(|eye| node.views[eye as usize].as_ref());
        let all_rows = regions.iter().flatten().map(|region| region.rows.clone());
        let Some(rows) = all_rows.reduce(|a, b| hull(&a, &b)) else { return };
        let seen = regions.iter().flatten().count();
        canvas.meter.note(|work| work.polygons += seen as u64);
        let polygon = &surfaces.opaque[node.polygon as usize];
        let formats = &surfaces.formats;
        let depth = node.depth.as_ref().filter(|_| *contested);
        // An edge and the inverse of its height, for all views or for each.
        let edge = |views| cost::edge(views) + Operations::new(0, 0, 1, 0);
        let corners = polygon.vertices.len() as u64;
        let shared = seen == EYES && *level;
        let edges = if shared { edge(EYES) } else { edge(1) * seen as u64 } * corners;
        let steps = if shared {
            let converted = scan.rows(polygon, *eyes, &rows, formats, |row, spans| {
                for view in 0..EYES {
                    let depth = depth.filter(|_| view + 1 < EYES);
                    canvas.draw(node.polygon, view, regions[view], row, spans[view], depth);
                }
            });
            [2 * converted, 2 * EYES * converted]
        } else {
            let mut steps = 0;
            for (view, region) in regions.into_iter().enumerate() {
                let Some(Region { rows, .. }) = region else { continue };
                let depth = depth.filter(|_| view + 1 < EYES);
                let converted =
                    scan_one.rows(polygon, [eyes[view]], rows, formats, |row, [span]| {
                        canvas.draw(node.polygon, view, region, row, span, depth);
                    });
                steps += 2 * converted;
            }
            [steps; 2]
        };
        canvas.meter.note(|work| {
            work.edge_updates += steps[0] as u64;
            work.interpolations += steps[1] as u64;
            // x of two edges is stepped for each row of a view, and compared.
            let rows = steps[1] as u64 / 2;
            work.fixed_point += Operations::new(2, 0, 0, 1) * rows + edges;
        });
    }
}

/// The buffers that are drawn on, and the meter of that work.
struct Canvas<'a, M, const EYES: usize> {
    items: &'a mut [Items; EYES],
    z_buffer: &'a mut ZBuffer,
    meter: &'a mut M,
}

impl<M: Meter, const EYES: usize> Canvas<'_, M, EYES> {
    /// Draws what a view has of a polygon's span, by depth if there is one. Called for every row.
    #[inline(always)]
    fn draw(
        &mut self,
        polygon: u32,
        view: usize,
        region: Option<&Region>,
        row: i32,
        span: [i32; 2],
        depth: Option<&Linear>,
    ) {
        let items = &mut self.items[view];
        let Some(region) = region else { return };
        let [first, end] = region.within(row, span, items.width as i32);
        if first >= end {
            return;
        }
        self.meter.note(|work| {
            work.pixels_tested += (end - first) as u64;
            work.pixels_written += (end - first) as u64;
        });
        let Some(depth) = depth else {
            return fill(&mut items.row(row)[first as usize..end as usize], polygon);
        };
        self.meter.note(|work| {
            work.depth_tests += (end - first) as u64;
            work.fixed_point += cost::LINEAR + cost::STEP_AND_COMPARE * (end - first) as u64;
        });
        self.z_buffer.draw(items, row, first..end, depth, polygon);
    }
}

/// Fills a span, which is often shorter than what loops over vectors are made for: in blocks, of
/// which the last one may lie over another.
#[inline]
fn fill(span: &mut [u32], polygon: u32) {
    const BLOCK: usize = 4;
    let block = [polygon; BLOCK];
    let length = span.len();
    if length < BLOCK {
        return span.iter_mut().for_each(|item| *item = polygon);
    }
    span.chunks_exact_mut(BLOCK).for_each(|items| items.copy_from_slice(&block));
    span[length - BLOCK..].copy_from_slice(&block);
}
