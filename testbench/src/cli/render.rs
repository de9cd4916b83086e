//! `wheatstone render`.

use super::*;
use crate::quality::Quality;
use crate::regression::drawn_line;
use wheatstone_golden::formats::{Eye, Rgba};
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::picture::{colour_picture, id_picture, write_png, Composite, Views};

#[derive(Debug, Args)]
pub(super) struct RenderArgs {
    /// How the second view is made
    #[arg(long, value_enum, default_value = "hybrid")]
    method: MethodChoice,
    /// Folder for the pictures; it is made if need be
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Composites of both views to write too
    #[arg(long, value_delimiter = ',', value_name = "KIND", value_parser = parse_composite,
        help = "Composites to write too: anaglyph, parallel, crossed, interleaved, wiggle")]
    stereo: Vec<Composite>,
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

fn parse_composite(text: &str) -> Result<Composite, String> {
    let names = Composite::ALL.map(|c| c.name()).join(", ");
    Composite::named(text).ok_or_else(|| format!("there are: {names}"))
}

pub(super) fn run(args: &RenderArgs) -> Result<u8, Failure> {
    let settings = args.common.settings()?;
    let name = args.common.scene.as_deref().unwrap_or("teapot");
    let geometry = args.common.geometry(name, args.common.size, &settings)?;
    // Before the work, so that a folder that cannot be made costs none.
    std::fs::create_dir_all(&args.out)
        .map_err(|source| WriteError { file: args.out.clone(), source })?;
    left_out(&geometry);
    let job = job(&settings, &geometry, settings.options);
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
    let pictures = [&frames[0], &frames[1]].map(picture);
    for eye in Eye::BOTH {
        let frame = &frames[eye as usize];
        save(&args.out, &format!("{}.png", eye.name()), &pictures[eye as usize])?;
        let id = |x: u32, y: u32| {
            Some(frame.id[(y * frame.width + x) as usize]).filter(|&id| id != NO_ID)
        };
        let ids = id_picture(frame.width, frame.height, id);
        save(&args.out, &format!("{}_ids.png", eye.name()), &ids)?;
    }
    for composite in &args.stereo {
        let file = args.out.join(format!("{}.png", composite.name()));
        composite.write(&file, &Views { left: &pictures[0], right: &pictures[1] })?;
        say!("image {}", file.display());
    }
    Ok(OK)
}

/// Says what is not drawn.
fn left_out(geometry: &Geometry) {
    let text = geometry.counts.to_string();
    if !text.is_empty() {
        say!("left out: {text}");
    }
    if geometry.polygons.is_empty() {
        tell!("warning: nothing to draw: all of the scene is left out, or there is nothing in it");
    }
}

fn save(folder: &Path, name: &str, picture: &image::RgbImage) -> Result<(), Failure> {
    let file = folder.join(name);
    write_png(&file, picture)?;
    say!("image {}", file.display());
    Ok(())
}

fn picture(frame: &Frame) -> image::RgbImage {
    let colours: Vec<Rgba> = frame.colour.iter().map(|&[r, g, b]| Rgba([r, g, b, 255])).collect();
    colour_picture(frame.width, frame.height, &colours)
}
