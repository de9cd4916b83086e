//! Ways to make the second view side by side: what is counted, and that errors are seen.

use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::picture::Rgb;
use wheatstone_golden::projection::Kind;
use wheatstone_golden::quality::Quality;
use wheatstone_golden::scene::{open, open_projected};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::text::Grouped;
use wheatstone_golden::work::{Unmetered, Work};
use wheatstone_studies::compare::{compare, error_picture, json, table, Judged, Timed, METHODS};
use wheatstone_studies::prepared::Prepared;
use wheatstone_tests::folder;

fn prepared(scene: &str) -> Prepared {
    Prepared::new(open(scene, Some([160, 120]), None).expect("built in")).expect("legal")
}

#[test]
fn every_method_is_measured_and_its_errors_drawn() {
    let folder = folder();
    let prepared = prepared("exclusive");
    let mut told = Vec::new();
    let outcomes =
        compare(&prepared, Some(folder.path()), |method| told.push(method.name)).expect("written");
    assert_eq!(told, METHODS.iter().map(|m| m.name).collect::<Vec<_>>());
    let measured = |name: &str| {
        let outcome = outcomes.iter().find(|o| o.method.name == name).expect(name);
        outcome.result.as_ref().unwrap_or_else(|e| panic!("{name}: {e}"))
    };
    for outcome in outcomes.iter().filter(|o| o.result.is_ok()) {
        let measured = measured(outcome.method.name);
        let time = measured.time;
        assert!(time.ratio.is_finite() && time.ratio >= 0.0, "{}", outcome.method.name);
        assert!(time.noise.is_finite() && time.noise >= 0.01, "{}", outcome.method.name);
        let text = time.to_string();
        assert_eq!(text.starts_with('<'), !time.is_measured(), "{text}");
        let views = if outcome.method.judged == Judged::Both { 2 } else { 1 };
        assert_eq!(measured.quality.pixels, views * 160 * 120);
        let picture = image::open(measured.file.as_ref().expect("a file")).expect("a picture");
        assert_eq!([picture.width(), picture.height()], [320, 120]);
    }
    let direct = measured("direct");
    assert!(direct.quality.decibels.is_infinite() && direct.quality.gaps == 0);
    assert_eq!(direct.quality.colours + direct.quality.ids, 0);
    assert!(direct.work.pixels_tested >= direct.work.pixels_written);
    // Coverage of the hybrid is exact.
    assert_eq!(measured("sam-hybrid").quality.ids, 0);
    let text = table(&outcomes);
    let json = json(&outcomes);
    for (n, method) in METHODS.iter().enumerate() {
        assert!(text.contains(method.name));
        assert_eq!(json[n]["method"], method.name);
    }
    assert_eq!(json[0]["both"]["identical"], true);
    assert_eq!(json[0]["work"]["pixels_tested"], direct.work.pixels_tested);
}

/// Coverage of the minimal system is not exact.
#[test]
fn wrong_polygons_are_counted() {
    let outcomes = compare(&prepared("village"), None, |_| ()).expect("done");
    let minimal = outcomes.iter().find(|outcome| outcome.method.name == "sam-minimal");
    let measured = minimal.expect("a method").result.as_ref().expect("it can");
    assert!(measured.quality.ids > 0);
}

/// The table of scenes on the page that compares the methods.
#[test]
fn the_page_of_comparison_has_the_beats_of_each_scene() {
    let page = include_str!("../docs/comparison.md");
    let grouped = |n: u64| Grouped(n).to_string();
    for scene in ["village", "office", "teapot", "atoms"] {
        let start = format!("| `{scene}`");
        let line = page.lines().find(|line| line.starts_with(&start)).expect(scene);
        let prepared = Prepared::new(open(scene, None, None).expect("built in")).expect("legal");
        let beats = |n: usize| (METHODS[n].draw)(&prepared).expect("it is drawn").work.beats;
        let [pass, derived] = [beats(0), beats(6)];
        let counts = prepared.job().planned(false);
        let part = (100.0 * derived as f64 / pass as f64).round();
        let [a, b, c, d] = [counts.polygons, counts.derived, derived, pass].map(grouped);
        assert!(line.contains(&format!("| {a} | {b} | {c} | {d} | {part} % |")), "{line}");
    }
}

/// With a head that the hardware is not built for nothing is derived, and the table says so.
#[test]
fn what_is_not_derived_is_told_with_its_reason() {
    let folder = folder();
    let file = folder.path().join("tilt.json");
    std::fs::write(&file, r#"{"head_tilt": 20}"#).expect("written");
    let scene = |rig| open("village", Some([80, 60]), rig).expect("built in");
    for (rig, derives) in [(None, true), (Some(file.as_path()), false)] {
        let prepared = Prepared::new(scene(rig)).expect("legal");
        let outcomes = compare(&prepared, None, |_| ()).expect("done");
        let (text, json) = (table(&outcomes), json(&outcomes));
        for (n, minimal) in [(5, true), (6, false)] {
            let name = METHODS[n].name;
            let counts = prepared.job().planned(minimal);
            assert_eq!(counts.derived > 0, derives);
            let line = text.lines().find(|line| line.starts_with(&format!("{name}: derived ")));
            let line = line.expect("a line beneath the table");
            assert_eq!(line.contains("derived 0 of"), !derives, "{line}");
            assert_eq!(line.contains(" tilted head"), !derives, "{line}");
            assert_eq!(json[n]["derivation"]["derived"], counts.derived);
            let other: u64 = counts.monocular.values().sum::<u64>() + counts.nothing;
            assert_eq!(counts.derived + other, counts.polygons);
        }
        assert!(json[0]["derivation"].is_null());
    }
}

/// If a view has a single pixel, the time of both views beyond that of one is less than noise.
#[test]
fn no_time_is_negative() {
    for kind in [Kind::TwoCentres, Kind::Shear] {
        let scene = open_projected("room", Some([1, 1]), None, Some(kind)).expect("built in");
        let outcomes = compare(&Prepared::new(scene).expect("legal"), None, |_| ()).expect("done");
        assert!(!table(&outcomes).contains(" -"), "a negative number");
        for (outcome, json) in outcomes.iter().zip(json(&outcomes).as_array().expect("a list")) {
            let Ok(measured) = &outcome.result else { continue };
            assert!(measured.time.ratio >= 0.0, "{}", outcome.method.name);
            assert_eq!(json["time_measured"], measured.time.is_measured());
        }
    }
}

#[test]
fn the_second_view_takes_what_the_first_alone_does_not() {
    let prepared = prepared("room");
    let job = prepared.job();
    let [left, right] = Eye::BOTH.map(|eye| {
        let mut work = Work::default();
        let frame = job.view(eye, &mut work);
        assert!(frame == job.view(eye, &mut Unmetered), "counting changes nothing");
        (frame, work)
    });
    // Every pixel that is covered was written, and each write was tested.
    let covered = right.0.id.iter().filter(|&&id| id != NO_ID).count() as u64;
    assert!(covered <= right.1.pixels_written && right.1.pixels_written <= right.1.pixels_tested);
    for method in METHODS {
        let pair = (method.draw)(&prepared).expect("it can be drawn");
        let first = match method.timed {
            Timed::Second(second) => {
                assert!(second(&prepared, &left.0) == pair.frames[1], "{}", method.name);
                left.0.clone()
            }
            Timed::Both { both, first } => {
                assert!(both(&prepared) == pair.frames, "{}", method.name);
                first(&prepared).swap_remove(0)
            }
        };
        // What is timed as the first view is the whole first view.
        assert!(first.id == left.0.id, "{}", method.name);
        let work = pair.work;
        // The systems' work is their beats.
        let system = method.name.starts_with("sam-");
        assert_eq!(work.arithmetic().all() > 0, !system, "{}: operations", method.name);
        assert!(work.pixels() > 0 && (work.beats > 0 || !system), "{}", method.name);
        assert!(work.beats < job.run(true, &mut Nothing).beats());
    }
}

/// Every way works with every projection; with a tilted head all but the one that shares rows.
#[test]
fn projections_and_tilted_heads() {
    let folder = folder();
    let file = folder.path().join("tilt.json");
    std::fs::write(&file, r#"{"head_tilt": 20}"#).expect("written");
    let mut cases: Vec<_> = Kind::ALL.into_iter().map(|kind| (None, kind)).collect();
    cases.push((Some(file.as_path()), Kind::TwoCentres));
    cases.push((Some(file.as_path()), Kind::Piecewise));
    for (rig, kind) in cases {
        let scene =
            open_projected("exclusive", Some([160, 120]), rig, Some(kind)).expect("built in");
        let prepared = Prepared::new(scene).expect("legal");
        let direct = prepared.job().direct();
        for method in METHODS {
            let what = format!("{}, {}, tilted {}", method.name, kind.name(), rig.is_some());
            let pair = match (method.draw)(&prepared) {
                Ok(pair) => pair,
                Err(unsuited) => {
                    assert!(method.name == "scan-line" && rig.is_some(), "{what}: {unsuited}");
                    assert!(unsuited.to_string().contains("scan lines share rows"), "{unsuited}");
                    continue;
                }
            };
            let job = prepared.job();
            let right = Quality::of(&job, Eye::Right, &pair.frames[1], &direct[1]);
            match method.name {
                "direct" | "scan-line" | "bsp-z" if kind != Kind::Symmetric => {
                    assert_eq!(right.ids, right.ties, "{what}");
                }
                // What is pixels away from where it belongs would be wrong nearly everywhere.
                "warping" if kind != Kind::Symmetric => {
                    assert!(right.ids * 4 < right.pixels, "{what}: {} wrong", right.ids);
                }
                _ => {}
            }
        }
    }
}

#[test]
fn ties_are_not_wrong_polygons() {
    let prepared = prepared("ties");
    let job = prepared.job();
    let [left, _] = job.direct();
    let of = |frame: &Frame| Quality::of(&job, Eye::Left, frame, &left);
    assert_eq!(of(&left).ties, 0);
    // Drawn in the other order, ties end with the other polygon, and only they do.
    let mut reversed = prepared.geometry.polygons.clone();
    reversed.reverse();
    let other = Job { polygons: &reversed, ..job.clone() }.view(Eye::Left, &mut Unmetered);
    let found = of(&other);
    assert!(found.ties > 50 && found.ids == found.ties, "{found:?}");
    // A polygon that is elsewhere is no tie, at whatever depth.
    let mut wrong = left.clone();
    let at = (0..wrong.id.len()).find(|&n| wrong.id[n] != NO_ID).expect("something is seen");
    let beside = wrong.id.iter().copied().filter(|&id| id != NO_ID).max().expect("the last one");
    wrong.id[at] = beside;
    assert_eq!((of(&wrong).ids, of(&wrong).ties), (1, 0));
    wrong.id[at] = NO_ID;
    assert_eq!((of(&wrong).ids, of(&wrong).ties, of(&wrong).gaps), (1, 0, 1));
}

/// Takes beats and does nothing with them.
struct Nothing;

impl wheatstone_golden::primary::Sink for Nothing {
    fn polygon(&mut self, _: u32) {}
    fn records(
        &mut self,
        _: &wheatstone_golden::pipeline::Setup,
        _: &wheatstone_golden::pipeline::Edges,
    ) {
    }
    fn beat(&mut self, _: &wheatstone_golden::pipeline::PrimaryBeat) {}
}

#[test]
fn error_pictures_show_what_is_wrong() {
    let mut direct = Frame::new(4, 1, [90, 90, 90]);
    direct.id = vec![1, 1, 1, NO_ID];
    let mut frame = direct.clone();
    let right = |n: u32, frame: &Frame| *error_picture(frame, &direct).get_pixel(n, 0);
    let plain = right(0, &frame);
    assert!((1..4).all(|n| right(n, &frame) == plain) && plain.0[0] == plain.0[1]);
    frame.id[0] = NO_ID;
    frame.id[1] = 2;
    frame.colour[2] = [90, 91, 90];
    frame.id[3] = 7;
    assert_eq!(right(0, &frame), Rgb([255, 0, 255]));
    assert_eq!(right(1, &frame), Rgb([255, 40, 40]));
    let Rgb([r, g, b]) = right(2, &frame);
    assert!(r == g && r > 60 && b == 0);
    assert_eq!(right(3, &frame), Rgb([255, 40, 40]));
}
