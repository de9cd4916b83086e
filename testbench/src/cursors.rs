//! Positions of the streams of a run in their tables.
//!
//! The shim compares rows and moves the cursors, so they hold pointers; [`crate::model`] relies
//! on what is kept here: a cursor is always at a whole row of its stream, or at the end of its
//! table, where nothing is read. Tables outlive their cursors.

use crate::layout::Layout;
use std::marker::PhantomData;
use std::sync::Arc;

/// Position of a stream in its table: shared with the shim, which moves it.
#[repr(C)]
pub(crate) struct Cursor {
    row: *const u64,
    end: *const u64,
    stride: u64,
    /// Beats taken.
    pub done: u64,
    /// Clocks on which a beat waited.
    pub stalled: u64,
    /// Cycle of the first beat.
    pub first: u64,
    /// Cycle of the last beat.
    pub last: u64,
}

/// Most fields that a stream can have.
pub(crate) const WORDS: usize = 256;

/// Words for the longest row.
pub(crate) type Words = [u64; WORDS];

/// The cursors of all streams: the module's first, then those of the probes.
pub(crate) struct Cursors<'a> {
    cursors: Vec<Cursor>,
    /// Rows that are not in a table, one a stream.
    own: Vec<Vec<u64>>,
    layout: Arc<Layout>,
    tables: PhantomData<&'a [u64]>,
}

impl<'a> Cursors<'a> {
    /// Cursors at the beginning of the tables of all streams, which are given row after row.
    pub fn new(layout: &Arc<Layout>, tables: &[Option<&'a [u64]>]) -> Cursors<'a> {
        let streams = layout.streams.iter().chain(layout.probed.iter().map(|(_, stream)| stream));
        let own: Vec<Vec<u64>> = streams.map(|stream| vec![0; stream.width]).collect();
        assert!(own.iter().all(|row| row.len() <= WORDS), "a stream has too many fields");
        let table = |number: usize| tables.get(number).copied().flatten();
        let cursor = |(number, own): (usize, &Vec<u64>)| {
            let range = table(number).map(|table| {
                assert!(table.len().is_multiple_of(own.len().max(1)), "a table has a broken row");
                table.as_ptr_range()
            });
            Cursor {
                row: range.as_ref().map_or(own.as_ptr(), |range| range.start),
                end: range.as_ref().map_or(std::ptr::null(), |range| range.end),
                stride: range.map_or(0, |_| own.len() as u64),
                done: 0,
                stalled: 0,
                first: 0,
                last: 0,
            }
        };
        let cursors = own.iter().enumerate().map(cursor).collect();
        Cursors { cursors, own, layout: layout.clone(), tables: PhantomData }
    }

    /// The row of a stream without a table, which `write` fills in, unless it declines.
    pub fn fill(&mut self, stream: usize, write: impl FnOnce(&mut [u64]) -> bool) -> bool {
        let filled = write(&mut self.own[stream]);
        if self.cursors[stream].stride == 0 {
            self.cursors[stream].row = self.own[stream].as_ptr();
        }
        filled
    }

    /// The cursors, for a call into the shim of the model that they were made for.
    #[inline]
    pub fn of(&mut self, layout: &Arc<Layout>) -> *mut Cursor {
        assert!(Arc::ptr_eq(&self.layout, layout), "cursors of another model");
        self.cursors.as_mut_ptr()
    }
}

impl std::ops::Index<usize> for Cursors<'_> {
    type Output = Cursor;

    #[inline]
    fn index(&self, stream: usize) -> &Cursor {
        &self.cursors[stream]
    }
}
