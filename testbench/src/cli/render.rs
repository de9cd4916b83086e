//! `wheatstone render`.

use super::failure::{Failure, OK};
use super::options::Common;
use super::places::Places;
use crate::regression::drawn_line;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use wheatstone_golden::files::Set;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::NO_ID;
use wheatstone_golden::picture::{
    frame_picture, id_picture, print_resolution, write_png, Composite, Views,
};
use wheatstone_golden::quality::Quality;
use wheatstone_golden::scene::height_field::EYE_SEPARATION;
use wheatstone_golden::scene::Geometry;
use wheatstone_golden::text::printable_path;

#[derive(Debug, Args)]
pub(super) struct RenderArgs {
    /// Method of making the second view
    #[arg(long, value_enum, default_value = "hybrid")]
    method: MethodChoice,
    /// Folder for the pictures; it is made if need be
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Composites of both views to write too
    #[arg(long, value_delimiter = ',', value_name = "KIND", value_parser = parse_composite,
        help = "Composites to write too: anaglyph, parallel, crossed, triplet, interleaved \
        (field-sequential), frame-sequential, wiggle")]
    stereo: Vec<Composite>,
    /// Dots per inch that composites have in print [default of parallel, crossed and triplet: so
    /// that points at infinity are 2.5 inches apart]
    #[arg(long, value_name = "N", value_parser = parse_dpi, requires = "stereo")]
    dpi: Option<f64>,
    #[command(flatten)]
    common: Common,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MethodChoice {
    /// Each view rasterised for itself
    Direct,
    /// The minimal system: spatial mapping and sampling only
    Minimal,
    /// The hybrid system
    Hybrid,
}

impl MethodChoice {
    /// Parameters that make no difference to the pictures, nor to what is said of them.
    fn ignored(self) -> &'static [&'static str] {
        match self {
            MethodChoice::Direct => {
                &["filter", "depth_test", "slots", "sampling", "display", "displays", "latency"]
            }
            MethodChoice::Minimal => {
                &["filter", "depth", "depth_test", "slots", "sampling", "latency"]
            }
            MethodChoice::Hybrid => &["slots", "latency"],
        }
    }
}

fn parse_composite(text: &str) -> Result<Composite, String> {
    let names = Composite::ALL.map(|c| c.name()).join(", ");
    Composite::named(text).ok_or_else(|| format!("there are: {names}"))
}

fn parse_dpi(text: &str) -> Result<f64, String> {
    let dots = text.parse().ok().filter(|dots| (1.0..=100_000.0).contains(dots));
    dots.ok_or_else(|| "expected dots per inch, a number from 1 to 100000".into())
}

pub(super) fn run(args: &RenderArgs) -> Result<u8, Failure> {
    Places::of_view(&args.common.view).folder("--out", Some(&args.out)).check()?;
    let settings = args.common.settings()?;
    let method = args.method.to_possible_value().map_or(String::new(), |m| m.get_name().to_owned());
    let what = format!("pictures by --method {method}");
    args.common.refuse_parameters(args.method.ignored(), &what)?;
    let name = args.common.view.scene.as_deref().unwrap_or("teapot");
    let scene = args.common.open(name, args.common.view.size)?;
    let geometry = args.common.geometry_of(&scene, &settings)?;
    if let Some(reason) = geometry.counts.nothing() {
        tell!("warning: {name}: nothing to draw: {reason}");
    }
    // Before the work, so that a folder that cannot be made costs none.
    let set = Set::new(&args.out)?;
    let mut files = Vec::new();
    let mut add = |name: String| {
        files.push(set.path().join(name));
        files[files.len() - 1].clone()
    };
    left_out(&geometry);
    let job = settings.job(&geometry);
    let start = std::time::Instant::now();
    let direct = job.direct();
    let direct_time = start.elapsed();
    let frames = match args.method {
        MethodChoice::Direct => {
            say!("both views directly in {direct_time:.1?}");
            say!("the hybrid would draw {}", drawn_line(&job.planned(false)));
            direct
        }
        method => {
            let start = std::time::Instant::now();
            let (frames, counts) = job.derived(method == MethodChoice::Minimal);
            say!("{} in {:.1?}", drawn_line(&counts), start.elapsed());
            for (eye, (frame, direct)) in Eye::BOTH.into_iter().zip(frames.eyes.iter().zip(&direct))
            {
                let quality = Quality::of(&job, eye, frame, direct);
                say!("{} view against direct rendering: {quality}", eye.name());
            }
            frames.eyes
        }
    };
    let pictures = [&frames[0], &frames[1]].map(frame_picture);
    for eye in Eye::BOTH {
        let frame = &frames[eye as usize];
        write_png(&add(format!("{}.png", eye.name())), &pictures[eye as usize])?;
        let id = |x: u32, y: u32| {
            Some(frame.id[(y * frame.width + x) as usize]).filter(|&id| id != NO_ID)
        };
        let ids = id_picture(frame.width, frame.height, id);
        write_png(&add(format!("{}_ids.png", eye.name())), &ids)?;
    }
    let wanted = Composite::ALL.iter().filter(|composite| args.stereo.contains(composite));
    for composite in wanted {
        let file = add(format!("{}.png", composite.name()));
        let free = composite.is_side_by_side().then(|| {
            let far = scene.rig.eye_separation * scene.rig.pixels_per_unit;
            print_resolution(pictures[0].width(), far, EYE_SEPARATION)
        });
        let views = Views { left: &pictures[0], right: &pictures[1] };
        composite.write(&file, &views, args.dpi.or(free))?;
    }
    let files: Vec<PathBuf> = files.iter().map(|file| set.named(file)).collect();
    set.finish("left.png", is_composite)?;
    files.iter().for_each(|file| say!("image {}", printable_path(file)));
    Ok(OK)
}

/// True if a file is a composite: one of an older run shows other views.
fn is_composite(name: &str) -> bool {
    Composite::ALL.iter().any(|composite| name.strip_suffix(".png") == Some(composite.name()))
}

/// Says what is not drawn.
fn left_out(geometry: &Geometry) {
    let text = geometry.counts.to_string();
    if !text.is_empty() {
        say!("left out: {text}");
    }
}
