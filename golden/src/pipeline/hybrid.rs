//! Hybrid system: edge functions, filter, coverage, depth and blending for the secondary (paper,
//! figure 4).

use super::blend::{blend, BlendPixel};
use super::coverage::{coverage, CoverageEdges, CoveragePixel};
use super::display::{display, DisplayPixel, DisplayPoint};
use super::edge_interpolator::*;
use super::filter::{Filter, FilterBeat, FilterPixel};
use super::front::{Front, Located};
use super::observer::{Observer, Unit};
use super::redirect::{redirect, Slot};
use super::sampler::{Sample, Sampler, SamplerBeat};
use super::{Edges, Op, Output, PrimaryBeat, Request, Setup};
use crate::config::Config;
use crate::formats::*;

/// State of the hybrid system.
#[derive(Clone, Debug)]
pub struct Hybrid {
    config: Config,
    formats: Formats,
    width: u32,
    single: bool,
    front: Front,
    /// Record of the polygon whose beats are behind stage S1.
    record: Edges,
    edges: [EdgeInterpolator<EdgeBeat>; 3],
    depth: EdgeInterpolator<DepthBeat>,
    colours: [EdgeInterpolator<ColourBeat>; 3],
    sampler: Sampler,
    filter: Filter,
    void: bool,
    error: bool,
}

/// A beat behind stage S2.
struct Interpolated {
    place: DisplayPixel,
    edges: CoverageEdges,
    depth: Depth,
    rgb: [u8; 3],
    sample: Option<Sample>,
    average: Option<FilterPixel>,
}

impl Hybrid {
    /// A hybrid system for views of this size; `single` sends both eyes to one display.
    pub fn new(config: &Config, width: u32, height: u32, single: bool) -> Hybrid {
        let formats = Formats::new(config);
        Hybrid {
            config: *config,
            formats,
            width,
            single,
            front: Front::new(config, formats, true, width, height),
            record: Edges::default(),
            edges: [(); 3].map(|()| EdgeInterpolator::new(formats, config.tilt)),
            depth: EdgeInterpolator::new(formats, config.tilt),
            colours: [(); 3].map(|()| EdgeInterpolator::new(formats, config.tilt)),
            sampler: Sampler::default(),
            filter: Filter::new(config),
            void: true,
            error: false,
        }
    }

    /// Whether a polygon or a beat was refused.
    pub fn error(&self) -> bool {
        self.error
    }

    /// Takes a beat; `record` are the records that a `LOAD` beat takes.
    #[inline]
    pub fn beat(
        &mut self,
        beat: &PrimaryBeat,
        record: &(Setup, Edges),
        output: &mut impl Output,
        observer: &mut impl Observer,
    ) {
        let [before, this] = self.front.step(beat, &record.0, observer);
        if let Some(before) = before {
            self.stage2(&before, output, observer);
        }
        if beat.op == Op::Load {
            self.record = record.1;
        }
        if let Some(this) = this {
            self.stage2(&this, output, observer);
        }
    }

    #[inline]
    fn stage2<O: Observer>(&mut self, beat: &Located, output: &mut impl Output, observer: &mut O) {
        match beat.beat.op {
            Op::Load => {
                let r = &self.record;
                let empty = [r.e0_a, r.e1_a, r.e2_a].iter().all(|a| a.raw() == 0);
                self.void = beat.bad || (beat.mode.is_binocular() && empty);
            }
            Op::Reserved => self.void = true,
            Op::Step | Op::Row => {}
        }
        self.error |= self.void;
        let interpolated = self.interpolate(beat, observer);
        // Only the beat that ends a secondary pixel, or a lent edge, needs the coverage.
        if O::ACTIVE || beat.lend || beat.end() {
            observer.input(Unit::Coverage, &interpolated.edges);
            let covered = coverage(&interpolated.edges, &self.formats);
            observer.output(Unit::Coverage, &covered);
            self.stage3(beat, &interpolated, &covered, output, observer);
        } else {
            self.stage3(beat, &interpolated, &CoveragePixel::default(), output, observer);
        }
    }

    #[inline]
    fn interpolate<O: Observer>(&mut self, beat: &Located, observer: &mut O) -> Interpolated {
        let primary = &beat.beat;
        let point =
            DisplayPoint { x: beat.x.x, y: beat.y().y, swap: beat.swap, mirror: beat.mirror };
        observer.input(Unit::Display, &point);
        let place = display(&point, self.width, &self.formats);
        observer.output(Unit::Display, &place);

        let [e0, e1, e2] = self.step_edges(beat, observer);
        let edges = CoverageEdges {
            value0: e0.value,
            a0: e0.a,
            b0: e0.b,
            low0: e0.low,
            value1: e1.value,
            a1: e1.a,
            b1: e1.b,
            low1: e1.low,
            value2: e2.value,
            a2: e2.a,
            b2: e2.b,
            low2: e2.low,
        };
        let depth = if self.config.interpolated_depth {
            self.step_depth(beat, observer)
        } else {
            Depth::default()
        };
        let rgb = if self.config.integrated { self.step_colours(beat, observer) } else { [0; 3] };

        let taken = SamplerBeat {
            first: beat.first(),
            end: beat.end(),
            near: beat.x.near,
            take: true,
            data: SampleData::pack(primary.rgba, primary.depth, &self.formats),
        };
        observer.input(Unit::Sampler, &taken);
        let sample = self.sampler.step(&taken);
        let filtered = FilterBeat {
            first: beat.first(),
            end: beat.end(),
            include: primary.centre,
            rgba: primary.rgba,
        };
        observer.input(Unit::Filter, &filtered);
        let average = if O::ACTIVE || beat.average { self.filter.step(&filtered) } else { None };
        if let (Some(sample), Some(average)) = (&sample, &average) {
            observer.output(Unit::Sampler, sample);
            observer.output(Unit::Filter, average);
        }
        Interpolated { place, edges, depth, rgb, sample, average }
    }

    #[inline]
    fn step_edges(&mut self, beat: &Located, observer: &mut impl Observer) -> [EdgeOutput; 3] {
        let r = &self.record;
        let loads = [
            (r.e0_start, r.e0_a, r.e0_b, r.e0_row, r.e0_low),
            (r.e1_start, r.e1_a, r.e1_b, r.e1_row, r.e1_low),
            (r.e2_start, r.e2_a, r.e2_b, r.e2_row, r.e2_low),
        ];
        let units = [Unit::Edge0, Unit::Edge1, Unit::Edge2];
        core::array::from_fn(|n| {
            let (start, a, b, row, low) = loads[n];
            let (op, save, r#move, y_move) =
                (beat.beat.op, beat.beat.save, beat.x.r#move, beat.y().r#move);
            let step = EdgeBeat { op, save, r#move, y_move, start, a, b, row, low };
            observer.input(units[n], &step);
            let value = self.edges[n].step(&step);
            observer.output(units[n], &value);
            value
        })
    }

    #[inline]
    fn step_depth(&mut self, beat: &Located, observer: &mut impl Observer) -> Depth {
        let r = &self.record;
        let step = DepthBeat {
            op: beat.beat.op,
            save: beat.beat.save,
            r#move: beat.x.r#move,
            y_move: beat.y().r#move,
            start: r.z_start,
            a: r.z_a,
            b: r.z_b,
            row: r.z_row,
            low: LowBits::default(),
        };
        observer.input(Unit::Depth, &step);
        let value = self.depth.step(&step);
        observer.output(Unit::Depth, &value);
        let depth = (value.value.raw() >> FRACTION_BITS).clamp(0, DEPTH_MAX.into());
        Depth::new(depth, &self.formats)
    }

    fn step_colours(&mut self, beat: &Located, observer: &mut impl Observer) -> [u8; 3] {
        let r = &self.record;
        let loads = [
            (r.red_start, r.red_a, r.red_b, r.red_row),
            (r.green_start, r.green_a, r.green_b, r.green_row),
            (r.blue_start, r.blue_a, r.blue_b, r.blue_row),
        ];
        let units = [Unit::Red, Unit::Green, Unit::Blue];
        core::array::from_fn(|n| {
            let (start, a, b, row) = loads[n];
            let (op, save, r#move, y_move) =
                (beat.beat.op, beat.beat.save, beat.x.r#move, beat.y().r#move);
            let low = LowBits::default();
            let step = ColourBeat { op, save, r#move, y_move, start, a, b, row, low };
            observer.input(units[n], &step);
            let value = self.colours[n].step(&step);
            observer.output(units[n], &value);
            (value.value.raw() >> FRACTION_BITS).clamp(0, 255) as u8
        })
    }

    /// Stage S3 and what follows it: the slot's pixels, drawn in order.
    #[inline]
    fn stage3(
        &mut self,
        beat: &Located,
        from: &Interpolated,
        covered: &CoveragePixel,
        output: &mut impl Output,
        observer: &mut impl Observer,
    ) {
        let f = &self.formats;
        let primary = &beat.beat;
        let (mask, centre) = if beat.lend {
            (primary.mask.raw() & covered.mask.raw(), primary.centre && covered.centre)
        } else {
            (primary.mask.raw(), primary.centre)
        };
        let derived = !self.void && beat.mode.is_binocular() && beat.end() && beat.inside();
        let mut slot = Slot {
            primary: !self.void && mask != 0,
            secondary: derived && covered.area.raw() != 0,
            eye: beat.mode.primary(),
            primary_x: primary.x,
            primary_y: primary.y,
            primary_rgba: primary.rgba,
            primary_area: Area::new((mask as u16).count_ones().into(), f),
            primary_depth: primary.depth,
            primary_write: centre,
            secondary_x: from.place.x,
            secondary_y: from.place.y,
            secondary_blended: true,
            ..Slot::default()
        };
        if slot.secondary {
            self.finish_secondary(beat, from, covered, &mut slot, output, observer);
        }
        if slot.primary || slot.secondary {
            observer.input(Unit::Redirect, &slot);
            for (stream, pixel) in redirect(&slot, self.single) {
                output.write(stream, &pixel);
            }
        }
    }

    /// Reads the background, tests the depth and blends.
    fn finish_secondary(
        &self,
        beat: &Located,
        from: &Interpolated,
        covered: &CoveragePixel,
        slot: &mut Slot,
        output: &mut impl Output,
        observer: &mut impl Observer,
    ) {
        let f = &self.formats;
        let sample = from.sample.unwrap_or_default().data;
        let colour = match from.average {
            Some(average) if beat.average && average.count.raw() > 0 => average.rgba,
            _ => sample.rgba(),
        };
        let planes = beat.planes && self.config.integrated;
        let rgb = if planes { from.rgb } else { colour.rgb() };
        let depth = if self.config.interpolated_depth { from.depth } else { sample.depth(f) };
        let behind = output.read(&Request {
            eye: beat.mode.primary().other(),
            x: slot.secondary_x,
            y: slot.secondary_y,
        });
        let keep = self.config.external_depth || depth < behind.depth;
        let pixel = BlendPixel {
            rgb,
            alpha: colour.0[3],
            area: covered.area,
            background: behind.rgb,
            tag: Tag::new(keep.into(), f),
        };
        observer.input(Unit::Blend, &pixel);
        let blended = blend(&pixel, f);
        observer.output(Unit::Blend, &blended);
        let [r, g, b] = blended.rgb;
        slot.secondary = keep;
        // Alpha and area go along although they are used up: whoever counts may want them.
        slot.secondary_rgba = Rgba([r, g, b, colour.0[3]]);
        slot.secondary_area = covered.area;
        slot.secondary_depth = depth;
        slot.secondary_write = covered.centre;
    }
}
