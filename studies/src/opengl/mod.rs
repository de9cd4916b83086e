//! Direct rendering of the office beside a software OpenGL renderer, where one is installed.

mod renderer;

pub use renderer::{compare_views, Comparison, Differences, Drawn, OpenGlError, Renderer};

use crate::p_buffer::measure::Office;
use crate::{timing, Check, Experiment, Report, Row, StudyError, Table};
use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::scene;
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;
use wheatstone_golden::work::Unmetered;

const SIZE: [u32; 2] = [640, 480];
/// Runs of each renderer; the shortest counts.
const ROUNDS: usize = 7;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "opengl",
    description: "direct rendering of fifteen office rooms beside a software OpenGL renderer",
    run,
};

/// Runs the experiment. Without a renderer its table says what to install.
fn run(_: &Path) -> Result<Report, StudyError> {
    let office = Office::new("office", SIZE)?;
    let table = match compare(&office) {
        Ok(table) => table,
        Err(StudyError::OpenGl(missing @ (OpenGlError::Compiler(_) | OpenGlError::Library))) => {
            Table { title: format!("Not measured: {missing}"), rows: Vec::new() }
        }
        Err(error) => return Err(error),
    };
    Ok(Report {
        experiment: "opengl".into(),
        publication: "none: the office of Heo, Jung and Wohn 1998".into(),
        tables: vec![table],
        files: Vec::new(),
    })
}

fn compare(office: &Office) -> Result<Table, StudyError> {
    let mut renderer = Renderer::build()?;
    let config = Config::DEFAULT;
    let formats = Formats::new(&config);
    let geometry = office.scene.geometry(&formats, &scene::Options::default())?;
    let polygons = &geometry.polygons;
    let views =
        |renderer: &Renderer| compare_views(renderer, polygons, SIZE, &formats, ROUNDS as u32);
    let all_threads = views(&renderer)?;
    renderer.threads = Some(1);
    let one_thread = views(&renderer)?;
    let job = Job::of(&geometry, config, Options::new(&config), Lookup::Nearest);
    let direct = timing::shortest(ROUNDS, || job.direct()).as_secs_f64();
    let mut buffers = Eye::BOTH.map(|eye| office.buffer(office.eyes[eye as usize]));
    let pipeline = timing::shortest(ROUNDS, || {
        for (buffer, view) in buffers.iter_mut().zip(office.eyes) {
            buffer.clear::<true>(view, office.scene.background);
            buffer.draw_all::<true>(&office.model, &mut Unmetered);
        }
    })
    .as_secs_f64();
    let differences = &one_thread.differences;
    let row =
        |what: &str, here: f64, digits: usize, check: Check| Row::new(what, here, digits, check);
    let rows = vec![
        row("pixels of both views", differences.pixels as f64, 0, Check::Trend),
        row("pixels where depths tie", differences.ties as f64, 0, Check::Trend),
        row("pixels that differ otherwise", differences.wrong as f64, 0, Check::AtMost(0.0)),
        row("OpenGL, one thread", 1e3 * one_thread.seconds, 1, Check::Trend).unit("ms"),
        row("OpenGL, all threads", 1e3 * all_threads.seconds, 1, Check::Trend).unit("ms"),
        row("direct rendering, one thread", 1e3 * direct, 1, Check::Trend).unit("ms"),
        row("full pipeline with ids, one thread", 1e3 * pipeline, 1, Check::Trend).unit("ms"),
        row("direct rendering : OpenGL", direct / one_thread.seconds, 2, Check::Trend),
        row("full pipeline : OpenGL", pipeline / one_thread.seconds, 2, Check::Trend),
    ];
    let [width, height] = SIZE;
    let title = format!(
        "Fifteen office rooms, {} triangles, both views of {width} x {height} pixels; {}",
        polygons.len(),
        one_thread.name
    );
    Ok(Table { title, rows })
}
