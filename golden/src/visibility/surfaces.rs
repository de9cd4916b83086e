//! Input of the hidden-surface algorithms.

use super::{Items, NO_ITEM};
use crate::cost;
use crate::direct::{depth_at, Direct, Shade};
use crate::formats::{Eye, Formats};
use crate::frame::Frame;
use crate::setup::{Attributes, Eyes, Outline, Polygon};
use crate::stereo::{pieces, Job};
use crate::texture::{Lookup, Texture};
use crate::work::{Meter, Unmetered};
use thiserror::Error;

/// The reason why hidden surfaces of a job cannot be resolved.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum VisibilityError {
    /// There is one item a pixel.
    #[error("hidden surfaces are resolved at pixel centres: expected a build without antialias")]
    Antialias,
    /// The views do not share their scan lines.
    #[error(
        "polygon {id}: expected the same y in both views, whose scan lines share rows and steps \
         along edges; with a tilted head a polygon crosses other rows in each view"
    )]
    Tilted {
        /// Its id.
        id: u32,
    },
}

/// The surfaces of a job: opaque ones that hide what is behind them, and the others.
#[derive(Clone, Debug)]
pub struct Surfaces<'a> {
    /// Opaque polygons, convex in both views, in the order they are drawn.
    pub opaque: Vec<Polygon>,
    /// Polygons that let something through; drawn after the opaque ones.
    pub translucent: Vec<Polygon>,
    /// Columns of each view.
    pub width: u32,
    /// Rows of each view.
    pub height: u32,
    /// Widths of the numbers.
    pub formats: Formats,
    /// A polygon that crosses other rows in the one view than in the other.
    tilted: Option<u32>,
    background: [u8; 3],
    textures: &'a [Texture],
    lookup: Lookup,
}

impl<'a> Surfaces<'a> {
    /// The surfaces of a job without anti-aliasing.
    pub fn new(job: &Job<'a>) -> Result<Surfaces<'a>, VisibilityError> {
        let formats = Formats::new(&job.config);
        if formats.mask_bits > 1 {
            return Err(VisibilityError::Antialias);
        }
        let tilted = |p: &&Polygon| p.vertices.iter().any(|v| v.y[0] != v.y[1]);
        let tilted = job.polygons.iter().find(tilted).map(|polygon| polygon.id);
        let drawn = pieces(job.polygons).filter_map(|p| drawn(p.into_owned()));
        let (opaque, translucent) = drawn.partition(|p| is_opaque(p, job.textures));
        let Job { width, height, background, textures, lookup, .. } = *job;
        let made = Surfaces {
            opaque,
            translucent,
            width,
            height,
            formats,
            tilted,
            background,
            textures,
            lookup,
        };
        Ok(made)
    }

    /// Refuses views that do not share their scan lines.
    pub fn level(&self) -> Result<(), VisibilityError> {
        self.tilted.map_or(Ok(()), |id| Err(VisibilityError::Tilted { id }))
    }

    /// A cleared item buffer.
    pub fn items(&self) -> Items {
        Items::new(self.width, self.height)
    }

    /// The frame of an eye that sees these items, coloured as direct rendering does it, with the
    /// translucent polygons drawn over it.
    pub fn frame(&self, items: &Items, eye: Eye) -> Frame {
        self.frame_metered(items, eye, &mut Unmetered)
    }

    /// The same, noting its arithmetic.
    pub fn frame_metered(&self, items: &Items, eye: Eye, meter: &mut impl Meter) -> Frame {
        let direct = Direct { formats: self.formats, textures: self.textures, lookup: self.lookup };
        let mut frame = Frame::new(self.width, self.height, self.background);
        let mut known: Vec<Option<Attributes>> = vec![None; self.opaque.len()];
        for (index, &item) in items.item.iter().enumerate().filter(|(_, &item)| item != NO_ITEM) {
            let polygon = &self.opaque[item as usize];
            let attributes = known[item as usize].get_or_insert_with(|| {
                let attributes = Attributes::new(polygon, eye, &self.formats);
                let corners = polygon.vertices.len();
                meter.note(|work| work.fixed_point += cost::attributes(corners, &attributes));
                attributes
            });
            meter.note(|work| work.fixed_point += cost::LINEAR + direct.colour_cost(polygon));
            let (x, y) = (index % self.width as usize, index / self.width as usize);
            let shade = Shade { attributes, polygon, direct: &direct };
            frame.colour[index] = shade.colour(x as i64, y as i64).rgb();
            frame.depth[index] = depth_at(&attributes.depth, x as i64, y as i64);
            frame.id[index] = polygon.id;
        }
        for polygon in &self.translucent {
            direct.draw_metered(polygon, eye, &mut frame, meter);
        }
        frame
    }
}

/// A polygon for the eyes that see an area of it, if there are any.
fn drawn(polygon: Polygon) -> Option<Polygon> {
    let sees = |eye| polygon.eyes.contains(eye) && Outline::new(&polygon, eye).doubled_area() != 0;
    let eyes = match Eye::BOTH.map(sees) {
        [true, true] => Eyes::Both,
        [true, false] => Eyes::One(Eye::Left),
        [false, true] => Eyes::One(Eye::Right),
        [false, false] => return None,
    };
    Some(Polygon { eyes, ..polygon })
}

/// True if nothing shows through a polygon.
fn is_opaque(polygon: &Polygon, textures: &[Texture]) -> bool {
    let texture = polygon.texture.and_then(|n| textures.get(n as usize));
    polygon.vertices.iter().all(|v| v.colour.iter().all(|c| c.0[3] == 255))
        && texture.is_none_or(|t| t.texels.iter().all(|texel| texel.0[3] == 255))
}
