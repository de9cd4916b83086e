//! Sampler: the primary pixel nearest the centre of the secondary pixel (paper, section 5.6).

use crate::beat;
use crate::formats::SampleData;

beat! {
    /// A beat, as the sampler takes it; the data is opaque to it.
    pub struct SamplerBeat {
        /// the beat opens a secondary pixel
        first: bool,
        /// the beat is the last in its secondary pixel
        end: bool,
        /// nearer to the centre than the beat before
        near: bool,
        /// the beat may be sampled
        take: bool,
        /// colour and depth
        data: SampleData,
    }
}

beat! {
    /// The sample of a secondary pixel.
    pub struct Sample {
        /// colour and depth of the nearest primary pixel, 0 without one
        data: SampleData,
        /// there was a primary pixel to take
        hit: bool,
    }
}

/// State of the sampler.
#[derive(Clone, Debug, Default)]
pub struct Sampler {
    candidate: Option<SampleData>,
}

impl Sampler {
    /// Takes a beat; gives the sample of the pixel it ends.
    #[inline]
    pub fn step(&mut self, beat: &SamplerBeat) -> Option<Sample> {
        if beat.first {
            self.candidate = None;
        }
        if beat.take && (beat.near || self.candidate.is_none()) {
            self.candidate = Some(beat.data);
        }
        beat.end.then(|| Sample {
            data: self.candidate.unwrap_or_default(),
            hit: self.candidate.is_some(),
        })
    }
}
