//! Building the tree.

use super::part::Part;
use super::piece::{Piece, Region, Window};
use super::plane::{Plane, Side};
use super::tree::{Node, Tree, NONE};
use crate::formats::Eye;
use crate::setup::{Attributes, Polygon};
use crate::visibility::Surfaces;
use std::cmp::Ordering;
use std::ops::Range;

/// Polygons of a cell that are tried as its root.
const CANDIDATES: usize = 16;
/// Polygons that each of them is tried against.
const SAMPLES: usize = 48;
/// A polygon cut counts as much as this many that are on one side too many.
const COST_OF_CUT: usize = 16;
/// Most pieces of a cell that is never divided by a line. Where no plane divides the rest, as of a
/// convex body, a tree is as deep as it has polygons, which takes steps by their square.
const SMALL_CELL: usize = 256;
/// Score from which a line is tried instead of a root: as of one that has three quarters of the
/// sample more on the one side than on the other.
const POOR: usize = 36;
/// Polygons that are looked at to place a line.
const LINE_SAMPLES: usize = 255;
/// A line may cross one in so many of them.
const MOST_CROSSED: usize = 4;

impl Tree {
    /// Builds the tree.
    ///
    /// The root of each cell is, of up to 16 evenly spaced polygons, the one that cuts fewest of a
    /// sample of 48 others and divides them most evenly; planes that pass between the eyes come
    /// last. Large cells that none of them divides well are divided by a row or a column of the views.
    pub fn new(surfaces: &Surfaces) -> Tree {
        Builder::new(surfaces).build()
    }
}

/// Along what a view is divided.
#[derive(Clone, Copy, Debug)]
enum Axis {
    Rows,
    Columns,
}

impl Axis {
    const BOTH: [Axis; 2] = [Axis::Rows, Axis::Columns];

    fn of(self, part: &Part) -> &Range<i32> {
        match self {
            Axis::Rows => &part.rows,
            Axis::Columns => &part.columns,
        }
    }

    /// Position of a piece, as the eyes see it, against a row or column of each: 0 before it, 2 behind it, 1 across it
    /// or different for the eyes.
    fn place(self, parts: &[Option<Part>; 2], at: [i32; 2]) -> usize {
        let found = parts.iter().zip(at).filter_map(|(part, at)| {
            let range = self.of(part.as_ref()?);
            Some(usize::from(range.end > at) + usize::from(range.start >= at))
        });
        found.reduce(|a, b| if a == b { a } else { 1 }).unwrap_or(1)
    }

    /// The line before a row or a column.
    fn line(self, at: i32, subpixel_bits: u32) -> Side {
        match self {
            Axis::Rows => Side::of_place([0, 1], at, subpixel_bits),
            Axis::Columns => Side::of_place([1, 0], at, subpixel_bits),
        }
    }
}

pub(super) struct Builder<'a> {
    polygons: &'a [Polygon],
    planes: Vec<[Option<Plane>; 2]>,
    windows: [Window; 2],
    nodes: Vec<Node>,
}

/// A subtree that is not built yet, and its parent.
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
        let root = self.root(&pieces, present);
        let poor = pieces.len() > SMALL_CELL && root.is_none_or(|(_, score)| score >= POOR);
        if let Some(line) = poor.then(|| self.line(&pieces)).flatten() {
            self.nodes.push(Node::new(NONE, [None, None], [Ordering::Equal; 2]));
            return self.parted(pieces, |builder, piece| builder.cut_by_line(piece, &line));
        }
        let Some((root, _)) = root else {
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
        self.parted(pieces, |builder, piece| builder.cut(piece, polygon))
    }

    /// The parts of some pieces on either side.
    fn parted(
        &self,
        pieces: Vec<Piece>,
        cut: impl Fn(&Self, Piece) -> [Option<Piece>; 2],
    ) -> [Vec<Piece>; 2] {
        let mut sides = [Vec::new(), Vec::new()];
        for piece in pieces {
            for (side, part) in sides.iter_mut().zip(cut(self, piece)) {
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
        let number = piece.polygon;
        // In the plane: of equal depths the polygon that comes first is seen.
        let in_plane = |view: usize| {
            let positive_is_far = planes[view].is_some_and(|plane| plane.far_side().is_gt());
            usize::from(positive_is_far == (number > root))
        };
        self.cut_along(piece, |view| self.side(number, view, planes), in_plane)
    }

    /// The parts of a piece above or left of a line in each view, and on the other side of it.
    fn cut_by_line(&self, piece: Piece, line: &[Side; 2]) -> [Option<Piece>; 2] {
        self.cut_along(piece, |view| Some(line[view]), |_| 1)
    }

    /// The parts of a piece where the function of each view is negative, and where it is not;
    /// `in_plane` tells where to put what lies in the plane wholly.
    fn cut_along(
        &self,
        piece: Piece,
        side: impl Fn(usize) -> Option<Side>,
        in_plane: impl Fn(usize) -> usize,
    ) -> [Option<Piece>; 2] {
        let polygon = &self.polygons[piece.polygon as usize];
        let mut views: [[Option<Region>; 2]; 2] = Default::default();
        for (view, region) in piece.views.into_iter().enumerate() {
            let (Some(region), Some(side)) = (region, side(view)) else { continue };
            match self.windows[view].sides(polygon, &region, &side) {
                [true, true] => views[view] = self.windows[view].cut(polygon, &region, &side),
                [true, false] => views[view][0] = Some(region),
                [false, true] => views[view][1] = Some(region),
                [false, false] => views[view][in_plane(view)] = Some(region),
            }
        }
        let [[left_low, left_high], [right_low, right_high]] = views;
        [[left_low, right_low], [left_high, right_high]].map(|views| {
            let seen = views.iter().any(Option::is_some);
            seen.then_some(Piece { polygon: piece.polygon, views })
        })
    }

    /// A row or a column of each view that divides a cell, where most pieces lie on one side of it. What is on different sides of it hides nothing of each other, in whatever order:
    /// it is the image of a plane through the eye.
    fn line(&self, pieces: &[Piece]) -> Option<[Side; 2]> {
        let sample: Vec<[Option<Part>; 2]> =
            spaced(pieces.len(), LINE_SAMPLES).map(|n| self.parts(&pieces[n])).collect();
        let lines = Axis::BOTH.map(|axis| {
            let at = [0, 1].map(|view| {
                let ranges = sample.iter().filter_map(|parts| parts[view].as_ref());
                let mut starts: Vec<i32> = ranges.map(|part| axis.of(part).start).collect();
                starts.sort_unstable();
                starts.get(starts.len() / 2).copied().unwrap_or_default()
            });
            let mut counts = [0; 3];
            for parts in &sample {
                counts[axis.place(parts, at)] += 1;
            }
            (counts, axis, at)
        });
        // Something on either side, or nothing would be gained.
        let gains = |([low, crossed, high], ..): &([usize; 3], Axis, [i32; 2])| {
            *low > 0 && *high > 0 && crossed * MOST_CROSSED < sample.len()
        };
        let best = lines.into_iter().filter(gains).min_by_key(|([_, crossed, _], ..)| *crossed);
        let bits = self.windows[0].formats.subpixel_bits;
        best.map(|(_, axis, at)| at.map(|at| axis.line(at, bits)))
    }

    /// Rectangles around what each eye sees of a piece.
    fn parts(&self, piece: &Piece) -> [Option<Part>; 2] {
        let polygon = &self.polygons[piece.polygon as usize];
        [0, 1].map(|view| {
            let region = piece.views[view].as_ref()?;
            let Part { columns, rows } = self.windows[view].part(polygon, region);
            let limits =
                region.limits.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
            let [first, end] = limits.unwrap_or([i32::MIN, i32::MAX]);
            Some(Part { columns: columns.start.max(first)..columns.end.min(end), rows })
        })
    }

    /// On which side of a plane a polygon is in a view.
    fn side(&self, polygon: u32, view: usize, planes: &[Option<Plane>; 2]) -> Option<Side> {
        Some(planes[view]?.side_of(&self.planes[polygon as usize][view]?))
    }

    /// Position of the piece that is to be the root, and its score: of a few evenly spaced candidates the one
    /// that cuts fewest of a sample and divides it most evenly. Planes that the eyes are on
    /// different sides of come last: above them there is one order for both views. None if no
    /// plane is known in all views that are present.
    fn root(&self, pieces: &[Piece], present: [bool; 2]) -> Option<(usize, usize)> {
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
        candidates.map(|n| (n, self.score(pieces, n))).min_by_key(|&(_, score)| score)
    }

    /// Cost of a root, from a sample of the pieces: those that it cuts, weighted, and the imbalance of its sides.
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

/// The parts of some pieces that the left eye sees, and those that the right eye sees.
fn apart(pieces: Vec<Piece>) -> [Vec<Piece>; 2] {
    let mut trees = [Vec::new(), Vec::new()];
    for Piece { polygon, views: [left, right] } in pieces {
        trees[0].extend(left.map(|left| Piece { polygon, views: [Some(left), None] }));
        trees[1].extend(right.map(|right| Piece { polygon, views: [None, Some(right)] }));
    }
    trees
}
