//! The memory beside a system: frame buffers that take its pixels and answer its reads.

use crate::job::Responder;
use fastrand::Rng;
use std::collections::VecDeque;
use wheatstone_golden::frame::Frames;
use wheatstone_golden::interface::{Beat, Interface, Table};
use wheatstone_golden::pipeline::{Pixel, Request, Response};

/// Longest random latency, in clocks.
const LONGEST: u64 = 24;

/// Frame buffers with a latency.
///
/// A read sees every pixel accepted before it. Whether it also sees those accepted before it is
/// answered is decided at random: a system must not depend on either.
pub struct Memory {
    /// The frame buffers.
    pub frames: Frames,
    /// The first answer that the golden model would not have given: its number, the answer
    /// expected and the one given.
    pub stale: Option<(u64, Response, Response)>,
    latency: Option<u64>,
    rng: Rng,
    reads: VecDeque<Read>,
    expected: Table,
    answered: u64,
    roles: Vec<Role>,
}

/// A read under way.
struct Read {
    request: Request,
    /// The answer, where it was taken at once.
    early: Option<Response>,
    due: u64,
}

/// What a stream of the system is to the memory.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Request,
    Pixels,
    Other,
}

impl Memory {
    /// A memory for a system's streams; `expected` are the answers of the golden model.
    pub fn new(
        interface: &Interface,
        frames: Frames,
        expected: Table,
        latency: Option<u64>,
        seed: u64,
    ) -> Memory {
        let role = |name: &str| match name {
            "request" => Role::Request,
            "left" | "right" => Role::Pixels,
            _ => Role::Other,
        };
        Memory {
            frames,
            stale: None,
            latency,
            rng: Rng::with_seed(seed),
            reads: VecDeque::new(),
            expected,
            answered: 0,
            roles: interface.streams.iter().map(|s| role(s.name)).collect(),
        }
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
        let number = self.answered as usize;
        if self.stale.is_none()
            && number < self.expected.len()
            && self.expected.row(number) != fields
        {
            self.stale = Some((self.answered, Response::read(self.expected.row(number)), response));
        }
        self.answered += 1;
        true
    }
}
