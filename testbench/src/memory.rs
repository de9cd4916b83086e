//! The memory beside a system: frame buffers that take its pixels and answer its reads.

use crate::job::Responder;
use crate::outcome::Difference;
use fastrand::Rng;
use std::collections::VecDeque;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Depth, Eye, Formats, Quantity};
use wheatstone_golden::frame::{Frame, Frames};
use wheatstone_golden::interface::{Beat, Interface, Table};
use wheatstone_golden::pipeline::{Pixel, Request, Response};

/// Colour and depth in a frame buffer are as wide in all configurations.
const FORMATS: Formats = Formats::new(&Config::DEFAULT);

/// Longest random latency, in clocks.
const LONGEST: u64 = 24;

/// Frame buffers with a latency.
///
/// A read sees every pixel accepted before it. Whether it also sees those accepted before it is
/// answered is decided at random: a system must not depend on either.
pub struct Memory {
    /// The frame buffers.
    pub frames: Frames,
    /// The first answer that the golden model would not have given.
    pub stale: Option<MemoryFault>,
    latency: Option<u64>,
    rng: Rng,
    reads: VecDeque<Read>,
    expected: Table,
    answered: u64,
    checked: usize,
    roles: Vec<Role>,
}

/// A read under way.
struct Read {
    request: Request,
    /// The answer, where it was taken at once.
    early: Option<Response>,
    due: u64,
}

/// The part that a stream of the system has for the memory.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Request,
    Pixels,
    Other,
}

impl Memory {
    /// A memory for a system's streams.
    pub fn new(interface: &Interface, frames: Frames, latency: Option<u64>, seed: u64) -> Memory {
        let role = |name: &str| match name {
            "request" => Role::Request,
            "left" | "right" | "pixel" => Role::Pixels,
            _ => Role::Other,
        };
        Memory {
            frames,
            stale: None,
            latency,
            rng: Rng::with_seed(seed),
            reads: VecDeque::new(),
            expected: Table::default(),
            answered: 0,
            checked: 0,
            roles: interface.streams.iter().map(|s| role(s.name)).collect(),
        }
    }

    /// The answers that the golden model gave to the reads that come next.
    pub fn expect(&mut self, answers: Option<&Table>) {
        self.expected = answers.cloned().unwrap_or_default();
        self.checked = 0;
    }

    fn fetch(&self, request: &Request) -> Response {
        self.frames.fetch(request.eye, request.x, request.y)
    }
}

impl Responder for Memory {
    fn accepted(&mut self, stream: usize, cycle: u64, row: &[u64]) {
        match self.roles[stream] {
            Role::Pixels => self.frames.apply(&Pixel::read(row)),
            Role::Request => {
                let request = Request::read(row);
                let early = self.rng.bool().then(|| self.fetch(&request));
                let latency = self.latency.unwrap_or_else(|| self.rng.u64(1..=LONGEST));
                // Answers stay in order.
                let earliest = self.reads.back().map_or(0, |read| read.due);
                self.reads.push_back(Read { request, early, due: earliest.max(cycle + latency) });
                self.frames.reads += 1;
            }
            Role::Other => {}
        }
    }

    fn respond(&mut self, _: usize, cycle: u64, row: &mut [u64]) -> bool {
        if self.reads.front().is_none_or(|read| read.due > cycle) {
            return false;
        }
        let Some(read) = self.reads.pop_front() else { return false };
        let response = read.early.unwrap_or_else(|| self.fetch(&read.request));
        let mut fields = Vec::with_capacity(row.len());
        response.write(&mut fields);
        row.copy_from_slice(&fields);
        let wrong = self.checked < self.expected.len() && self.expected.row(self.checked) != fields;
        if wrong && self.stale.is_none() {
            let expected = Response::read(self.expected.row(self.checked));
            let (read, actual) = (self.answered, response);
            self.stale = Some(MemoryFault::Stale { read, expected, actual });
        }
        self.checked += 1;
        self.answered += 1;
        true
    }
}

/// A difference in the frame buffers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MemoryFault {
    /// A background read gave something else than the golden model read.
    Stale {
        /// Number of the read.
        read: u64,
        /// Colour and depth that the golden model read.
        expected: Response,
        /// Colour and depth that the memory held.
        actual: Response,
    },
    /// A pixel of a frame buffer differs at the end.
    Pixel {
        /// Whose.
        eye: Eye,
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// Colour and depth of the golden model.
        expected: Response,
        /// Colour and depth of the Verilog.
        actual: Response,
        /// Number of pixels that differ.
        count: u64,
    },
}

impl MemoryFault {
    /// The fields that differ.
    pub fn differences(&self) -> Vec<Difference> {
        let (Self::Stale { expected, actual, .. } | Self::Pixel { expected, actual, .. }) = self;
        let fields = Response::fields(&FORMATS);
        let [expected, actual] = [expected, actual].map(|response| {
            let mut row = Vec::new();
            response.write(&mut row);
            row
        });
        Difference::all(&fields, &expected, &actual)
    }
}

/// Frame buffers that differ: the first pixel, and how many.
pub(crate) fn compare_frames(golden: &Frames, actual: &Frames) -> Vec<MemoryFault> {
    let mut faults = Vec::new();
    for eye in Eye::BOTH {
        let [golden, actual] = [golden, actual].map(|f| &f.eyes[eye as usize]);
        let held = |frame: &Frame, n: usize| Response {
            rgb: frame.colour[n],
            depth: Depth::new(frame.depth[n].into(), &FORMATS),
        };
        let pixels = 0..golden.colour.len();
        let mut different = pixels.filter(|&n| held(golden, n) != held(actual, n));
        if let Some(first) = different.next() {
            let (expected, actual) = (held(golden, first), held(actual, first));
            let (x, y) = (first as u32 % golden.width, first as u32 / golden.width);
            let count = 1 + different.count() as u64;
            faults.push(MemoryFault::Pixel { eye, x, y, expected, actual, count });
        }
    }
    faults
}
