//! Building the tree.

use super::piece::{Piece, Region, Window};
use super::plane::{Plane, Side};
use super::{Node, Part, Tree, NONE};
use crate::formats::Eye;
use crate::setup::{Attributes, Polygon};
use crate::visibility::Surfaces;
use std::cmp::Ordering;

/// Polygons of a cell that are tried as its root.
const CANDIDATES: usize = 16;
/// Polygons that each of them is tried against.
const SAMPLES: usize = 48;
/// A polygon cut counts as much as this many that are on one side too many.
const COST_OF_CUT: usize = 16;

pub(super) struct Builder<'a> {
    polygons: &'a [Polygon],
    planes: Vec<[Option<Plane>; 2]>,
    windows: [Window; 2],
    nodes: Vec<Node>,
}

/// What is to become a subtree, and whose.
struct Cell {
    pieces: Vec<Piece>,
    parent: Option<(u32, usize)>,
}

impl<'a> Builder<'a> {
    pub fn new(surfaces: &'a Surfaces) -> Builder<'a> {
        let Surfaces { opaque: polygons, width, height, formats, .. } = surfaces;
        let planes = polygons.iter().map(|p| Eye::BOTH.map(|eye| Plane::new(p, eye))).collect();
        let window = |eye| Window { eye, width: *width, height: *height, formats: *formats };
        Builder { polygons, planes, windows: Eye::BOTH.map(window), nodes: Vec::new() }
    }

    pub fn build(mut self) -> Tree {
        let whole = |(n, polygon): (usize, &Polygon)| {
            let views = self.windows.map(|window| window.whole(polygon));
            let seen = views.iter().any(Option::is_some);
            seen.then_some(Piece { polygon: n as u32, views })
        };
        let pieces = self.polygons.iter().enumerate().filter_map(whole).collect();
        // Not by recursion: a tree of a convex body is as deep as it has faces.
        let mut cells = vec![Cell { pieces, parent: None }];
        while let Some(cell) = cells.pop() {
            if cell.pieces.is_empty() {
                continue;
            }
            let number = self.nodes.len() as u32;
            if let Some((parent, side)) = cell.parent {
                self.nodes[parent as usize].sides[side] = number;
            }
            let children = self.divide(cell.pieces);
            for (side, pieces) in children.into_iter().enumerate() {
                cells.push(Cell { pieces, parent: Some((number, side)) });
            }
        }
        self.contest();
        Tree { nodes: self.nodes }
    }

    /// Adds a node for the root of some pieces; the others, on its negative and positive side.
    fn divide(&mut self, mut pieces: Vec<Piece>) -> [Vec<Piece>; 2] {
        let present = [0, 1].map(|view| pieces.iter().any(|piece| piece.views[view].is_some()));
        let Some(root) = self.root(&pieces, present) else {
            // No plane divides both views, so each has a tree of its own.
            self.nodes.push(Node::new(NONE, [None, None], [Ordering::Equal; 2]));
            return apart(pieces);
        };
        let Piece { polygon, views } = pieces.swap_remove(root);
        let planes = self.planes[polygon as usize];
        let far = [0, 1].map(|view| match planes[view] {
            Some(plane) if present[view] => plane.far_side(),
            _ => Ordering::Equal,
        });
        self.nodes.push(Node::new(polygon, views, far));
        let mut sides = [Vec::new(), Vec::new()];
        for piece in pieces {
            let parts = self.cut(piece, polygon);
            for (side, part) in sides.iter_mut().zip(parts) {
                side.extend(part);
            }
        }
        sides
    }

    /// Finds the planes below which the order for the left eye may be another, and prepares for
    /// depth to decide there. Nodes come before those below them.
    fn contest(&mut self) {
        let mut parts: Vec<Option<Part>> = vec![None; self.nodes.len()];
        for n in (0..self.nodes.len()).rev() {
            let node = &mut self.nodes[n];
            let own = node.views[0]
                .as_ref()
                .map(|region| self.windows[0].part(&self.polygons[node.polygon as usize], region));
            let [low, high] = node.sides.map(|side| parts.get(side as usize).cloned().flatten());
            let both = |a: &Option<Part>, b: &Option<Part>| match (a, b) {
                (Some(a), Some(b)) => a.meets(b),
                _ => false,
            };
            let meet = both(&low, &high) || both(&low, &own) || both(&high, &own);
            let part = [low, high, own].into_iter().flatten().reduce(|a, b| a.with(&b));
            let [left, right] = node.far;
            if meet && left == right.reverse() && left.is_ne() {
                node.contested = part.clone();
            }
            parts[n] = part;
        }
        let mut below = vec![false; self.nodes.len()];
        for n in 0..self.nodes.len() {
            let node = &mut self.nodes[n];
            below[n] |= node.contested.is_some();
            if below[n] && node.views[0].is_some() {
                let polygon = &self.polygons[node.polygon as usize];
                node.depth = Some(Attributes::depth(polygon, Eye::Left, &self.windows[0].formats));
            }
            for side in node.sides.into_iter().filter(|&side| side != NONE) {
                below[side as usize] = below[n];
            }
        }
    }

    /// The parts of a piece on the negative and the positive side of a polygon's plane.
    fn cut(&self, piece: Piece, root: u32) -> [Option<Piece>; 2] {
        let planes = &self.planes[root as usize];
        let polygon = &self.polygons[piece.polygon as usize];
        let mut views: [[Option<Region>; 2]; 2] = Default::default();
        for (view, region) in piece.views.into_iter().enumerate() {
            let (Some(region), Some(side)) = (region, self.side(piece.polygon, view, planes))
            else {
                continue;
            };
            match self.windows[view].sides(polygon, &region, &side) {
                [true, true] => views[view] = self.windows[view].cut(polygon, &region, &side),
                [true, false] => views[view][0] = Some(region),
                [false, true] => views[view][1] = Some(region),
                // In the plane: of equal depths the polygon that comes first is seen.
                [false, false] => {
                    let positive_is_far = planes[view].is_some_and(|p| p.far_side().is_gt());
                    let far = piece.polygon > root;
                    views[view][usize::from(positive_is_far == far)] = Some(region);
                }
            }
        }
        let [[left_low, left_high], [right_low, right_high]] = views;
        [[left_low, right_low], [left_high, right_high]].map(|views| {
            let seen = views.iter().any(Option::is_some);
            seen.then_some(Piece { polygon: piece.polygon, views })
        })
    }

    /// On which side of a plane a polygon is in a view.
    fn side(&self, polygon: u32, view: usize, planes: &[Option<Plane>; 2]) -> Option<Side> {
        Some(planes[view]?.side_of(&self.planes[polygon as usize][view]?))
    }

    /// Position of the piece that is to be the root: of a few evenly spaced candidates the one
    /// that cuts fewest of a sample and divides it most evenly. Planes that the eyes are on
    /// different sides of come last: above them there is one order for both views. None if no
    /// plane is known in all views that are present.
    fn root(&self, pieces: &[Piece], present: [bool; 2]) -> Option<usize> {
        let known = |piece: &Piece| {
            let planes = &self.planes[piece.polygon as usize];
            [0, 1].iter().all(|&view| !present[view] || planes[view].is_some())
        };
        let agreed = |piece: &Piece| {
            let [a, b] = self.planes[piece.polygon as usize].map(|p| p.map(|p| p.far_side()));
            present != [true, true] || a == b
        };
        let all: Vec<usize> = (0..pieces.len()).filter(|&n| known(&pieces[n])).collect();
        let best: Vec<usize> = all.iter().copied().filter(|&n| agreed(&pieces[n])).collect();
        let candidates = if best.is_empty() { all } else { best };
        let candidates = spaced(candidates.len(), CANDIDATES).map(|n| candidates[n]);
        candidates.min_by_key(|&n| self.score(pieces, n))
    }

    /// How bad a root is.
    fn score(&self, pieces: &[Piece], root: usize) -> usize {
        let planes = &self.planes[pieces[root].polygon as usize];
        let (mut cuts, mut low, mut high) = (0, 0, 0usize);
        for piece in spaced(pieces.len(), SAMPLES).filter(|&n| n != root).map(|n| &pieces[n]) {
            let polygon = &self.polygons[piece.polygon as usize];
            let mut found = [false; 2];
            for view in (0..2).filter(|&view| piece.views[view].is_some()) {
                let side = self.side(piece.polygon, view, planes);
                let sides = side.map(|side| self.windows[view].corner_sides(polygon, &side));
                found = [0, 1].map(|k| found[k] || sides.is_some_and(|sides| sides[k]));
            }
            match found {
                [true, true] => cuts += 1,
                [_, true] => high += 1,
                _ => low += 1,
            }
        }
        COST_OF_CUT * cuts + high.abs_diff(low)
    }
}

/// At most `most` numbers below `count`, evenly spaced.
fn spaced(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let taken = count.min(most);
    (0..taken).map(move |k| k * count / taken)
}

/// What the left and the right eye see of some pieces.
fn apart(pieces: Vec<Piece>) -> [Vec<Piece>; 2] {
    let mut trees = [Vec::new(), Vec::new()];
    for Piece { polygon, views: [left, right] } in pieces {
        trees[0].extend(left.map(|left| Piece { polygon, views: [Some(left), None] }));
        trees[1].extend(right.map(|right| Piece { polygon, views: [None, Some(right)] }));
    }
    trees
}
