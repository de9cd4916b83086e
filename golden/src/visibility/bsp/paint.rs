//! Traversals that paint.

use super::scan::Scan;
use super::{Node, Tree, NONE};
use crate::direct::depth_at;
use crate::formats::Eye;
use crate::setup::{Attributes, Linear};
use crate::visibility::{Items, Surfaces};
use crate::work::Meter;
use std::cmp::Ordering;

/// What one eye sees, by a traversal for it.
pub fn one(surfaces: &Surfaces, tree: &Tree, eye: Eye, meter: &mut impl Meter) -> Items {
    let mut items = [surfaces.items()];
    draw(surfaces, tree, [eye], &mut items, &mut ZBuffer::default(), meter);
    let [items] = items;
    items
}

/// What both eyes see, by one traversal.
pub fn both(surfaces: &Surfaces, tree: &Tree, meter: &mut impl Meter) -> [Items; 2] {
    let mut items = [(); 2].map(|()| surfaces.items());
    draw(surfaces, tree, Eye::BOTH, &mut items, &mut ZBuffer::default(), meter);
    items
}

/// Depths of the left view, where the order does not decide.
///
/// What is painted later under another plane is nearer than all before it, so depths are kept
/// relative to that plane's turn, and the buffer is never cleared.
#[derive(Clone, Debug, Default)]
pub struct ZBuffer {
    depths: Vec<i64>,
    turn: i64,
}

impl ZBuffer {
    /// Begins a turn, for a view of this size.
    fn begin(&mut self, pixels: usize) {
        self.turn += 1;
        self.depths.resize(pixels, i64::MAX);
    }

    /// Keeps a polygon where it is nearer.
    fn span(&mut self, items: &mut [u32], start: usize, depth: impl Fn(i64) -> u32, polygon: u32) {
        let depths = &mut self.depths[start..start + items.len()];
        for (n, (item, least)) in items.iter_mut().zip(depths).enumerate() {
            let depth = i64::from(depth(n as i64)) - (self.turn << 32);
            if depth < *least {
                (*item, *least) = (polygon, depth);
            }
        }
    }
}

/// What is left to do of a traversal.
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
    let mut painter = Painter { surfaces, eyes, items, z_buffer, meter, contested: false };
    let root = if tree.nodes.is_empty() { NONE } else { 0 };
    let mut tasks = vec![Task::Visit(root)];
    while let Some(task) = tasks.pop() {
        match task {
            Task::Visit(NONE) => {}
            Task::Paint(node) => painter.node(&tree.nodes[node as usize]),
            Task::Agree => painter.contested = false,
            Task::Visit(number) => {
                let node = &tree.nodes[number as usize];
                if EYES > 1 && !painter.contested && node.is_contested() {
                    painter.contest();
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
    items: &'a mut [Items; EYES],
    z_buffer: &'a mut ZBuffer,
    meter: &'a mut M,
    /// Whether all but the last view are to be resolved by depth.
    contested: bool,
}

impl<M: Meter, const EYES: usize> Painter<'_, M, EYES> {
    /// The far side of a node for the eye whose order is followed, or for the one that sees
    /// something below it.
    fn far(&self, node: &Node) -> Ordering {
        let far = self.eyes.map(|eye| node.far[eye as usize]);
        far.into_iter().rev().find(|far| far.is_ne()).unwrap_or(Ordering::Equal)
    }

    fn contest(&mut self) {
        self.contested = true;
        self.z_buffer.begin(self.items[0].item.len());
    }

    /// Paints the polygon of a node, in all views at once.
    fn node(&mut self, node: &Node) {
        let regions = self.eyes.map(|eye| node.views[eye as usize].as_ref());
        let seen = regions.iter().flatten();
        let rows = seen.fold(i32::MAX..i32::MIN, |rows, region| {
            rows.start.min(region.rows.start)..rows.end.max(region.rows.end)
        });
        if rows.is_empty() {
            return;
        }
        let polygon = &self.surfaces.opaque[node.polygon as usize];
        let formats = &self.surfaces.formats;
        let depth = (self.contested && regions[0].is_some())
            .then(|| Attributes::depth(polygon, self.eyes[0], formats));
        self.meter.note(|work| work.polygons += regions.iter().flatten().count() as u64);
        Scan::new(polygon, self.eyes, &rows, formats).rows(|row, spans| {
            self.meter.note(|work| {
                work.edge_updates += 2;
                work.interpolations += 2 * EYES as u64;
            });
            for view in 0..EYES {
                let Some(region) = regions[view] else { continue };
                let [low, high] = region.limit(row);
                let [first, end] = spans[view];
                let width = self.items[view].width as i32;
                let (first, end) = (first.max(low).max(0), end.min(high).min(width));
                if first < end {
                    let depth = depth.as_ref().filter(|_| view == 0);
                    self.span(view, row, [first, end], node.polygon, depth);
                }
            }
        });
    }

    #[inline]
    fn span(
        &mut self,
        view: usize,
        row: i32,
        columns: [i32; 2],
        polygon: u32,
        depth: Option<&Linear>,
    ) {
        let [first, end] = columns.map(|n| n as usize);
        self.meter.note(|work| work.pixels_written += (end - first) as u64);
        let start = row as usize * self.items[view].width as usize + first;
        let span = &mut self.items[view].row(row)[first..end];
        let Some(depth) = depth else { return span.fill(polygon) };
        self.meter.note(|work| work.depth_tests += (end - first) as u64);
        let at = |n: i64| depth_at(depth, first as i64 + n, row.into());
        self.z_buffer.span(span, start, at, polygon);
    }
}
