//! Traversals that paint.

use super::piece::Region;
use super::scan::Scan;
use super::{Node, Part, Tree, NONE};
use crate::formats::{Eye, FRACTION_BITS};
use crate::setup::Linear;
use crate::visibility::depths::keep_nearer;
use crate::visibility::scan_line::Line;
use crate::visibility::{Items, Surfaces};
use crate::work::Meter;
use std::cmp::Ordering;
use std::ops::Range;

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
    let mut painter = Painter {
        surfaces,
        eyes,
        items,
        z_buffer,
        meter,
        contested: false,
        scan: Scan::new(),
        scan_one: Scan::new(),
        spans: Vec::new(),
        top: 0,
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
                    painter.z_buffer.clear(&painter.items[0], part);
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
    scan: Scan<EYES>,
    scan_one: Scan<1>,
    /// Spans of the polygon in the views, from row `top` on.
    spans: Vec<[[i32; 2]; EYES]>,
    top: i32,
}

impl<M: Meter, const EYES: usize> Painter<'_, M, EYES> {
    /// The far side of a node for the eye whose order is followed, or for the one that sees
    /// something below it.
    fn far(&self, node: &Node) -> Ordering {
        let far = self.eyes.map(|eye| node.far[eye as usize]);
        far.into_iter().rev().find(|far| far.is_ne()).unwrap_or(Ordering::Equal)
    }

    /// Paints the polygon of a node: converts its edges for all views at once, then fills. If not
    /// all eyes see this piece, it is converted for the one that does.
    fn node(&mut self, node: &Node) {
        let regions = self.eyes.map(|eye| node.views[eye as usize].as_ref());
        let seen = regions.iter().flatten().count();
        if seen == 0 {
            return;
        }
        let rows = regions.iter().flatten().fold(i32::MAX..i32::MIN, |rows, region| {
            rows.start.min(region.rows.start)..rows.end.max(region.rows.end)
        });
        let polygon = &self.surfaces.opaque[node.polygon as usize];
        let formats = &self.surfaces.formats;
        self.spans.clear();
        if seen == EYES {
            let push = |spans| self.spans.push(spans);
            self.top = self.scan.rows(polygon, self.eyes, &rows, formats, push);
        } else {
            let view = usize::from(regions[0].is_none());
            let push = |[span]: [[i32; 2]; 1]| self.spans.push([span; EYES]);
            self.top = self.scan_one.rows(polygon, [self.eyes[view]], &rows, formats, push);
        }
        self.meter.note(|work| {
            work.polygons += seen as u64;
            work.edge_updates += 2 * self.spans.len() as u64;
            work.interpolations += (2 * seen * self.spans.len()) as u64;
        });
        for (view, region) in regions.into_iter().enumerate() {
            let Some(region) = region else { continue };
            match &node.depth {
                Some(depth) if view + 1 < EYES && self.contested => {
                    self.compare(view, region, node.polygon, depth);
                }
                _ => self.fill(view, region, node.polygon),
            }
        }
    }

    /// Fills the spans of a view.
    fn fill(&mut self, view: usize, region: &Region, polygon: u32) {
        let items = &mut self.items[view];
        let width = items.width as i32;
        for (row, spans) in (self.top..).zip(&self.spans) {
            let [first, end] = region.within(row, spans[view], width);
            if first < end {
                self.meter.note(|work| work.pixels_written += (end - first) as u64);
                items.row(row)[first as usize..end as usize].fill(polygon);
            }
        }
    }

    /// Draws the spans of a view where they are nearer.
    fn compare(&mut self, view: usize, region: &Region, polygon: u32, depth: &Linear) {
        const UNIT: f64 = (1 << FRACTION_BITS) as f64;
        let items = &mut self.items[view];
        let width = items.width as i32;
        for (row, spans) in (self.top..).zip(&self.spans) {
            let [first, end] = region.within(row, spans[view], width);
            if first < end {
                self.meter.note(|work| {
                    work.pixels_written += (end - first) as u64;
                    work.depth_tests += (end - first) as u64;
                });
                let depths = self.z_buffer.span(items, row, first..end);
                let items = &mut items.row(row)[first as usize..end as usize];
                let first = depth.at(first.into(), row.into());
                let line = Line { first: first as f64 / UNIT, slope: depth.a as f64 / UNIT };
                keep_nearer(items, depths, line, polygon);
            }
        }
    }
}
