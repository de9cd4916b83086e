//! Frame buffers: what becomes of a pixel.

use crate::formats::{Area, Coordinate, Depth, Eye, Formats, Quantity, Rgba, DEPTH_MAX};
use crate::pipeline::blend::{factor, mix};
use crate::pipeline::{Output, Pixel, Request, Response};
use crate::setup::{Placement, Planner};

/// Id of a place where nothing was drawn.
pub const NO_ID: u32 = u32::MAX;

/// The columns of each view that are drawn; pixels beside them are dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scissor {
    /// First column of the left and of the right view.
    pub first: [u32; 2],
    /// Column behind the last one.
    pub end: [u32; 2],
}

impl Default for Scissor {
    /// All columns.
    fn default() -> Scissor {
        Scissor { first: [0; 2], end: [u32::MAX; 2] }
    }
}

impl Scissor {
    /// True if a column of an eye's view is drawn.
    #[inline]
    pub fn contains(&self, eye: Eye, column: i64) -> bool {
        let [first, end] = [self.first, self.end].map(|n| i64::from(n[eye as usize]));
        (first..end).contains(&column)
    }
}

/// The scissor of one eye's view on its display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Window {
    first: i64,
    end: i64,
    /// The view's columns are rows of the display.
    swap: bool,
}

impl Window {
    fn new(scissor: &Scissor, eye: Eye, placement: &Placement) -> Window {
        let [first, end] = [scissor.first, scissor.end].map(|n| i64::from(n[eye as usize]));
        // A row of the view says where its columns go.
        let column = |x: i64| placement.place(x, 0)[usize::from(placement.swap)];
        let [a, b] = [column(first), column(end - 1)];
        Window { first: a.min(b), end: a.max(b) + 1, swap: placement.swap }
    }

    #[inline]
    fn contains(&self, x: i64, y: i64) -> bool {
        (self.first..self.end).contains(if self.swap { &y } else { &x })
    }
}

/// Frame buffer of one eye: colour, depth and the id of the polygon drawn last.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Colours, row by row from the top.
    pub colour: Vec<[u8; 3]>,
    /// Depths, 24 bits.
    pub depth: Vec<u32>,
    /// Ids, [`NO_ID`] where nothing was drawn.
    pub id: Vec<u32>,
}

impl Frame {
    /// A cleared frame.
    pub fn new(width: u32, height: u32, background: [u8; 3]) -> Frame {
        let pixels = width as usize * height as usize;
        Frame {
            width,
            height,
            colour: vec![background; pixels],
            depth: vec![DEPTH_MAX; pixels],
            id: vec![NO_ID; pixels],
        }
    }

    /// Clears colours and depths, and with `IDS` the ids.
    pub fn clear<const IDS: bool>(&mut self, background: [u8; 3]) {
        self.colour.fill(background);
        self.depth.fill(DEPTH_MAX);
        if IDS {
            self.id.fill(NO_ID);
        }
    }

    /// Position of a pixel in the vectors; none outside.
    pub fn index(&self, x: i64, y: i64) -> Option<usize> {
        let inside =
            (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        inside.then(|| y as usize * self.width as usize + x as usize)
    }

    /// Clears the columns that are `beside`.
    pub fn clear_columns(&mut self, beside: impl Fn(i64) -> bool, background: [u8; 3]) {
        for index in 0..self.id.len() {
            if beside((index % self.width as usize) as i64) {
                self.colour[index] = background;
                (self.depth[index], self.id[index]) = (DEPTH_MAX, NO_ID);
            }
        }
    }

    /// Draws an unblended fragment: depth test, blending, depth write.
    #[inline]
    pub fn draw(&mut self, index: usize, fragment: &Fragment, formats: &Formats) {
        if fragment.depth >= self.depth[index] {
            return;
        }
        let t = factor(fragment.rgba.0[3], fragment.area, formats);
        let behind = self.colour[index];
        self.colour[index] = core::array::from_fn(|n| mix(fragment.rgba.0[n], behind[n], t));
        if t > 0 {
            self.id[index] = fragment.id;
        }
        if fragment.write {
            self.depth[index] = fragment.depth;
        }
    }
}

/// An unblended pixel of one polygon.
#[derive(Clone, Copy, Debug)]
pub struct Fragment {
    /// Colour and alpha.
    pub rgba: Rgba,
    /// Covered samples.
    pub area: Area,
    /// Depth.
    pub depth: u32,
    /// True if the depth is written.
    pub write: bool,
    /// Id of the polygon.
    pub id: u32,
}

/// The frame buffers of both eyes, as a system's output streams fill them.
#[derive(Clone, Debug)]
pub struct Frames {
    /// Left and right frame.
    pub eyes: [Frame; 2],
    /// Id given to the pixels written next.
    pub id: u32,
    /// Pixels that arrived for each eye.
    pub written: [u64; 2],
    /// Reads that were answered.
    pub reads: u64,
    /// Depth of secondary pixels was tested by the system.
    tested: bool,
    windows: [Window; 2],
    formats: Formats,
}

impl Frames {
    /// Cleared frames for the displays that a planner arranges the views on. `tested`: blended pixels
    /// have passed the depth test already.
    pub fn new(planner: &Planner, background: [u8; 3], tested: bool, scissor: &Scissor) -> Frames {
        let [width, height] = Placement::display_size(planner);
        let frame = Frame::new(width, height, background);
        let window = |eye| Window::new(scissor, eye, &Placement::new(planner, eye));
        Frames {
            eyes: [frame.clone(), frame],
            id: NO_ID,
            written: [0; 2],
            reads: 0,
            tested,
            windows: Eye::BOTH.map(window),
            formats: planner.formats,
        }
    }

    /// Position of a pixel in an eye's frame; none outside the frame.
    #[inline]
    fn index(&self, eye: Eye, x: Coordinate, y: Coordinate) -> Option<usize> {
        self.eyes[eye as usize].index(x.raw(), y.raw())
    }

    /// The part of an eye's frame that takes pixels: first column and the one behind the last, first row
    /// and the one behind the last.
    pub fn open(&self, eye: Eye) -> [u32; 4] {
        let Frame { width, height, .. } = self.eyes[eye as usize];
        let Window { first, end, swap } = self.windows[eye as usize];
        // No column is beyond 32 bits once it is cut to the frame.
        let cut = |n: i64, size: u32| n.clamp(0, size.into()) as u32;
        if swap {
            [0, width, cut(first, height), cut(end, height)]
        } else {
            [cut(first, width), cut(end, width), 0, height]
        }
    }

    /// True if blended pixels have passed the depth test already.
    pub fn is_tested(&self) -> bool {
        self.tested
    }

    /// Response to a read: the content of the frame, beside the scissor too, where nothing is ever drawn; 0 outside the
    /// frame.
    pub fn fetch(&self, eye: Eye, x: Coordinate, y: Coordinate) -> Response {
        let frame = &self.eyes[eye as usize];
        match self.index(eye, x, y) {
            Some(index) => Response {
                rgb: frame.colour[index],
                depth: Depth::new(frame.depth[index].into(), &self.formats),
            },
            None => Response::default(),
        }
    }

    /// Applies a pixel.
    #[inline]
    pub fn apply(&mut self, pixel: &Pixel) {
        self.written[pixel.eye as usize] += 1;
        if !self.windows[pixel.eye as usize].contains(pixel.x.raw(), pixel.y.raw()) {
            return;
        }
        let Some(index) = self.index(pixel.eye, pixel.x, pixel.y) else { return };
        let frame = &mut self.eyes[pixel.eye as usize];
        let depth = pixel.depth.raw() as u32;
        if !pixel.blended {
            let (rgba, area, write, id) = (pixel.rgba, pixel.area, pixel.write, self.id);
            frame.draw(index, &Fragment { rgba, area, depth, write, id }, &self.formats);
            return;
        }
        if self.tested || depth < frame.depth[index] {
            frame.colour[index] = pixel.rgba.rgb();
            // Alpha and area are used up in the colour, but tell whether there is any of it.
            if factor(pixel.rgba.0[3], pixel.area, &self.formats) > 0 {
                frame.id[index] = self.id;
            }
            if pixel.write {
                frame.depth[index] = depth;
            }
        }
    }
}

impl Output for Frames {
    #[inline]
    fn read(&mut self, request: &Request) -> Response {
        self.reads += 1;
        self.fetch(request.eye, request.x, request.y)
    }
    #[inline]
    fn write(&mut self, _: Eye, pixel: &Pixel) {
        self.apply(pixel);
    }
}
