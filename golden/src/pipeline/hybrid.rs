//! Hybrid system: edge functions, filter, coverage, depth and blending for the secondary (paper,
//! figure 4).

use super::blend::{blend, BlendPixel};
use super::coverage::{coverage, CoverageEdges, CoveragePixel};
use super::display::{display, DisplayPixel, DisplayPoint};
use super::edge_interpolator::*;
use super::filter::{Filter, FilterBeat, FilterPixel};
use super::front::{Front, Located, Step};
use super::observer::{Observer, Unit};
use super::redirect::{route, Slot};
use super::sampler::{Sample, Sampler, SamplerBeat};
use super::{Edges, Op, Output, Pixel, PrimaryBeat, Request, Setup};
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
    /// Eye of a polygon that passes by the units.
    passing: Option<Eye>,
}

/// Control fields of a beat, common to all interpolators.
struct Movement {
    op: Op,
    save: bool,
    r#move: bool,
    y_move: Move,
}

impl Movement {
    #[inline]
    fn of(beat: &Located) -> Movement {
        let (op, save) = (beat.beat.op, beat.beat.save);
        Movement { op, save, r#move: beat.x.r#move, y_move: beat.y().r#move }
    }
}

/// Steps an interpolator. `load` is the whole beat; where nobody watches, only a `LOAD` needs it.
#[inline]
fn step_unit<B: Interpolant, O: Observer>(
    model: &mut EdgeInterpolator<B>,
    unit: Unit,
    beat: &Located,
    load: B,
    observer: &mut O,
) -> B::Output {
    if O::ACTIVE {
        observer.input(unit, &load);
        let output = model.step(&load);
        observer.output(unit, &output);
        return output;
    }
    let Movement { op, save, r#move, y_move } = Movement::of(beat);
    if op == Op::Load {
        model.load(&load);
    }
    model.advance(op, save, r#move.into(), y_move.raw());
    model.output()
}

/// A beat behind stage S2.
#[derive(Default)]
struct Interpolated {
    place: DisplayPixel,
    depth: DepthPlane,
    rgb: [ColourPlane; 3],
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
            passing: None,
        }
    }

    /// True if a polygon or a beat was refused.
    pub fn error(&self) -> bool {
        self.error
    }

    /// Takes a beat; `record` are the records that a `LOAD` beat takes.
    #[inline]
    pub fn beat<O: Observer>(
        &mut self,
        beat: &PrimaryBeat,
        record: &(Setup, Edges),
        output: &mut impl Output,
        observer: &mut O,
    ) {
        if !O::ACTIVE {
            if let Some(eye) = self.passes_by(beat, &record.0) {
                self.void = false;
                let primary = self.primary_pixel(beat, eye, beat.mask.raw(), beat.centre);
                return self.emit(eye, primary, None, output, observer);
            }
        }
        let Step { before, this } = self.front.step(beat, &record.0, observer);
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

    /// Stage S2: the interpolants at the secondary pixel, and what is gathered in it.
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
        let edges = self.step_edges(beat, observer);
        let mut interpolated = Interpolated::default();
        if self.config.interpolated_depth {
            interpolated.depth = self.step_depth(beat, observer);
        }
        if self.config.integrated {
            interpolated.rgb = self.step_colours(beat, observer);
        }
        self.gather(beat, &mut interpolated, observer);
        // Only the beat that ends a secondary pixel, or a lent edge, needs the rest.
        if O::ACTIVE || beat.lend || beat.end() {
            let covered = self.cover(&edges, observer);
            self.place(beat, &mut interpolated, observer);
            self.stage3(beat, &interpolated, &covered, output, observer);
        } else {
            let (eye, primary) = (beat.mode.primary(), &beat.beat);
            let pixel = self.primary_pixel(primary, eye, primary.mask.raw(), primary.centre);
            self.emit(eye, pixel, None, output, observer);
        }
    }

    /// Sampler and filter.
    #[inline]
    fn gather<O: Observer>(&mut self, beat: &Located, to: &mut Interpolated, observer: &mut O) {
        let primary = &beat.beat;
        let (first, end) = (beat.first(), beat.end());
        let data = SampleData::pack(primary.rgba, primary.depth, &self.formats);
        let taken = SamplerBeat { first, end, near: beat.x.near, take: true, data };
        observer.input(Unit::Sampler, &taken);
        to.sample = self.sampler.step(&taken);
        if O::ACTIVE || beat.average {
            let filtered = FilterBeat { first, end, include: primary.centre, rgba: primary.rgba };
            observer.input(Unit::Filter, &filtered);
            to.average = self.filter.step(&filtered);
        }
        if let (Some(sample), Some(average)) = (&to.sample, &to.average) {
            observer.output(Unit::Sampler, sample);
            observer.output(Unit::Filter, average);
        }
    }

    /// Coverage unit.
    #[inline]
    fn cover(&self, [e0, e1, e2]: &[EdgeOutput; 3], observer: &mut impl Observer) -> CoveragePixel {
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
        observer.input(Unit::Coverage, &edges);
        let covered = coverage(&edges, &self.formats);
        observer.output(Unit::Coverage, &covered);
        covered
    }

    /// Display unit.
    #[inline]
    fn place(&self, beat: &Located, to: &mut Interpolated, observer: &mut impl Observer) {
        let point =
            DisplayPoint { x: beat.x.x, y: beat.y().y, swap: beat.swap, mirror: beat.mirror };
        observer.input(Unit::Display, &point);
        to.place = display(&point, self.width, &self.formats);
        observer.output(Unit::Display, &to.place);
    }

    /// Steps the three edges.
    #[inline]
    fn step_edges<O: Observer>(&mut self, beat: &Located, observer: &mut O) -> [EdgeOutput; 3] {
        let Movement { op, save, r#move, y_move } = Movement::of(beat);
        let Hybrid { record: r, edges: [e0, e1, e2], .. } = self;
        let mut step = |edge: &mut _, unit, start, a, b, row, low| {
            let load = EdgeBeat { op, save, r#move, y_move, start, a, b, row, low };
            step_unit(edge, unit, beat, load, observer)
        };
        [
            step(e0, Unit::Edge0, r.e0_start, r.e0_a, r.e0_b, r.e0_row, r.e0_low),
            step(e1, Unit::Edge1, r.e1_start, r.e1_a, r.e1_b, r.e1_row, r.e1_low),
            step(e2, Unit::Edge2, r.e2_start, r.e2_a, r.e2_b, r.e2_row, r.e2_low),
        ]
    }

    /// Steps the depth.
    #[inline]
    fn step_depth<O: Observer>(&mut self, beat: &Located, observer: &mut O) -> DepthPlane {
        let r = &self.record;
        let Movement { op, save, r#move, y_move } = Movement::of(beat);
        let (start, a, b, row) = (r.z_start, r.z_a, r.z_b, r.z_row);
        let low = LowBits::default();
        let load = DepthBeat { op, save, r#move, y_move, start, a, b, row, low };
        step_unit(&mut self.depth, Unit::Depth, beat, load, observer).value
    }

    /// Steps the colour planes.
    #[inline]
    fn step_colours<O: Observer>(&mut self, beat: &Located, observer: &mut O) -> [ColourPlane; 3] {
        let r = &self.record;
        let loads = [
            (r.red_start, r.red_a, r.red_b, r.red_row),
            (r.green_start, r.green_a, r.green_b, r.green_row),
            (r.blue_start, r.blue_a, r.blue_b, r.blue_row),
        ];
        let units = [Unit::Red, Unit::Green, Unit::Blue];
        core::array::from_fn(|n| {
            let (start, a, b, row) = loads[n];
            let Movement { op, save, r#move, y_move } = Movement::of(beat);
            let low = LowBits::default();
            let load = ColourBeat { op, save, r#move, y_move, start, a, b, row, low };
            step_unit(&mut self.colours[n], units[n], beat, load, observer).value
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
        let primary = &beat.beat;
        let eye = beat.mode.primary();
        let (mask, centre) = if beat.lend {
            (primary.mask.raw() & covered.mask.raw(), primary.centre && covered.centre)
        } else {
            (primary.mask.raw(), primary.centre)
        };
        let primary = self.primary_pixel(primary, eye, mask, centre);
        let derived = !self.void && beat.mode.is_binocular() && beat.end() && beat.inside();
        let secondary = if derived && covered.area.raw() != 0 {
            self.secondary_pixel(beat, from, covered, output, observer)
        } else {
            None
        };
        self.emit(eye, primary, secondary, output, observer);
    }

    /// The primary pixel of a beat, if it is drawn.
    #[inline]
    fn primary_pixel(
        &self,
        beat: &PrimaryBeat,
        eye: Eye,
        mask: i64,
        centre: bool,
    ) -> Option<Pixel> {
        (!self.void && mask != 0).then(|| Pixel {
            eye,
            x: beat.x,
            y: beat.y,
            rgba: beat.rgba,
            area: Area::new((mask as u16).count_ones().into(), &self.formats),
            depth: beat.depth,
            write: centre,
            blended: false,
        })
    }

    /// Sends the pixels of a slot to their eyes.
    #[inline]
    fn emit<O: Observer>(
        &self,
        eye: Eye,
        primary: Option<Pixel>,
        secondary: Option<Pixel>,
        output: &mut impl Output,
        observer: &mut O,
    ) {
        if O::ACTIVE && (primary.is_some() || secondary.is_some()) {
            observer.input(Unit::Redirect, &Slot::new(eye, primary, secondary));
        }
        for pixel in primary.iter().chain(&secondary) {
            output.write(route(pixel.eye, self.single), pixel);
        }
    }

    /// Eye of the polygon that a beat belongs to, if that polygon concerns no unit but redirection.
    /// If nobody watches the units, such beats need not go through them: the next `LOAD` renews all
    /// they hold.
    #[inline]
    fn passes_by(&mut self, beat: &PrimaryBeat, setup: &Setup) -> Option<Eye> {
        match beat.op {
            Op::Load => {
                let mode = setup.mode;
                let alone = mode.is_legal() && !mode.is_binocular() && !setup.lend;
                self.passing = (alone && !self.front.is_waiting()).then_some(mode.primary());
            }
            Op::Reserved => self.passing = None,
            Op::Step | Op::Row => {}
        }
        self.passing
    }

    /// Reads the background, tests the depth and blends: the secondary pixel, if it is drawn.
    #[inline]
    fn secondary_pixel(
        &self,
        beat: &Located,
        from: &Interpolated,
        covered: &CoveragePixel,
        output: &mut impl Output,
        observer: &mut impl Observer,
    ) -> Option<Pixel> {
        let f = &self.formats;
        let sample = from.sample.unwrap_or_default().data;
        let colour = match from.average {
            Some(average) if beat.average && average.count.raw() > 0 => average.rgba,
            _ => sample.rgba(),
        };
        let planes = beat.planes && self.config.integrated;
        let rgb = if planes {
            from.rgb.map(|c| (c.raw() >> FRACTION_BITS).clamp(0, 255) as u8)
        } else {
            colour.rgb()
        };
        let depth = if self.config.interpolated_depth {
            let depth = (from.depth.raw() >> FRACTION_BITS).clamp(0, DEPTH_MAX.into());
            Depth::new(depth, f)
        } else {
            sample.depth(f)
        };
        let (eye, DisplayPixel { x, y }) = (beat.mode.primary().other(), from.place);
        let behind = output.read(&Request { eye, x, y });
        let keep = self.config.external_depth || depth < behind.depth;
        let alpha = colour.0[3];
        let pixel = BlendPixel {
            rgb,
            alpha,
            area: covered.area,
            background: behind.rgb,
            tag: Tag::new(keep.into(), f),
        };
        observer.input(Unit::Blend, &pixel);
        let blended = blend(&pixel, f);
        observer.output(Unit::Blend, &blended);
        let [r, g, b] = blended.rgb;
        keep.then_some(Pixel {
            eye,
            x,
            y,
            // Alpha and area go along although they are used up: whoever counts may want them.
            rgba: Rgba([r, g, b, alpha]),
            area: covered.area,
            depth,
            write: covered.centre,
            blended: true,
        })
    }
}
