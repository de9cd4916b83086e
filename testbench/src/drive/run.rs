//! A run: its tables and masks, which do not change, and the state of its streams.

use crate::cursors::{Cursors, Words};
use crate::job::Job;
use crate::layout::StreamSignals;
use crate::model::{Library, Model};
use crate::stalls::Pattern;
use wheatstone_golden::interface::{Direction, Table};

/// The bits of a mask, lowest first.
#[inline]
pub(super) fn bits(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = mask.trailing_zeros();
        mask &= mask.wrapping_sub(1);
        (bit < u64::BITS).then_some(bit as usize)
    })
}

/// The fields of the beat on a stream's signals.
pub(super) fn payload(model: &Model, stream: &StreamSignals) -> Vec<u64> {
    (0..stream.width).map(|field| model.peek(stream.field(field))).collect()
}

/// State of the streams in a cycle, a bit a stream.
#[derive(Clone, Copy, Default)]
pub(super) struct State {
    /// Inputs that have a beat and wait for their gate.
    pub waiting: u32,
    /// Inputs that are offering a beat.
    pub offered: u32,
    /// Inputs served in the last cycle.
    pub freed: u32,
    /// Outputs with a beat that was not taken in the last cycle.
    pub held: u32,
    /// Streams with rows left, or answers due.
    pub unfinished: u32,
}

/// A run; the masks here do not change.
pub(crate) struct Run<'a> {
    /// Tables of all streams, the module's first, then those of the probes.
    pub(super) tables: Vec<Option<&'a Table>>,
    pub(super) cursors: Cursors<'a>,
    pub(super) gates: &'a [u32],
    /// Outputs are ready for beats only that were offered in the last cycle and not taken.
    pub(super) until_valid: bool,
    /// Random words, for the fields of inputs that offer nothing.
    pub(super) junk: &'a [Words; JUNK],
    pub(super) inputs: u32,
    pub(super) outputs: u32,
    /// Streams with a table.
    pub(super) tabled: u32,
    /// Inputs that answer requests, and the numbers of both.
    pub(super) answers: u32,
    pub(super) pairs: Vec<(usize, usize)>,
    /// Probed streams that are compared.
    pub(super) watched: u64,
}

/// Rows of random words.
pub(crate) const JUNK: usize = 16;

impl<'a> Run<'a> {
    /// Prepares a run; the job was checked. The length of `gates` is a power of two.
    pub fn new(
        library: &Library,
        job: &Job<'a>,
        gates: &'a [u32],
        junk: &'a [Words; JUNK],
    ) -> Run<'a> {
        let layout = library.layout();
        let tables = [job.tables, job.probes].concat();
        let values: Vec<Option<&[u64]>> = tables.iter().map(|t| t.map(Table::values)).collect();
        let mask = |tables: &[Option<&Table>]| -> u64 {
            let bit = |(i, table): (usize, &Option<&Table>)| u64::from(table.is_some()) << i;
            tables.iter().enumerate().map(bit).sum()
        };
        let answering = layout.streams.iter().enumerate();
        let pairs: Vec<(usize, usize)> =
            answering.filter_map(|(i, s)| s.answers.map(|request| (i, request))).collect();
        Run {
            cursors: Cursors::new(layout, &values),
            gates,
            until_valid: job.stalls.back_pressure == Pattern::UntilValid,
            junk,
            inputs: layout.mask(Direction::Input),
            outputs: layout.mask(Direction::Output),
            tabled: mask(job.tables) as u32,
            answers: pairs.iter().map(|(answer, _)| 1 << answer).sum(),
            pairs,
            watched: mask(job.probes),
            tables,
        }
    }

    /// The state before the first clock.
    pub(super) fn begin(&self) -> State {
        let tables = self.tables.iter().take(32).enumerate();
        let filled = |(i, table): (usize, &Option<&Table>)| {
            u32::from(table.is_some_and(|table| !table.is_empty())) << i
        };
        let unfinished = tables.map(filled).sum::<u32>() & (self.inputs | self.outputs);
        let waiting = unfinished & self.inputs & !self.answers;
        State { waiting, unfinished, ..State::default() }
    }
}
