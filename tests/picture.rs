//! Pictures on disk: whole or not there.

use std::fs;
use std::path::Path;
use std::process::Command;
use wheatstone_golden::files;
use wheatstone_golden::picture::{write_png, write_wiggle, Composite, Rgb, RgbImage, Views};

fn noise(width: u32, height: u32, seed: u64) -> RgbImage {
    let mut random = fastrand::Rng::with_seed(seed);
    RgbImage::from_fn(width, height, |_, _| Rgb([random.u8(..), random.u8(..), random.u8(..)]))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn pictures_come_back_as_they_were() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.png");
    for (width, height) in [(1, 1), (640, 480), (7, 2048)] {
        let picture = noise(width, height, u64::from(width));
        write_png(&path, &picture).expect("written");
        assert_eq!(image::open(&path).expect("a picture").into_rgb8(), picture);
    }
    assert_eq!(names(folder.path()), ["picture.png"]);
}

#[test]
fn all_composites_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let (left, right) = (noise(32, 24, 1), noise(32, 24, 2));
    let views = Views { left: &left, right: &right };
    for composite in Composite::ALL {
        let path = folder.path().join(format!("{}.png", composite.name()));
        composite.write(&path, &views, None).expect("written");
        let picture = image::open(&path).expect("a picture").into_rgb8();
        let size = match composite {
            Composite::Parallel | Composite::Crossed => (64, 24),
            Composite::Triplet => (96, 24),
            Composite::FrameSequential => (32, 48),
            _ => (32, 24),
        };
        assert_eq!(picture.dimensions(), size);
    }
    let crossed = image::open(folder.path().join("crossed.png")).expect("a picture").into_rgb8();
    assert_eq!(crossed.get_pixel(0, 5), right.get_pixel(0, 5));
}

#[test]
fn a_wiggle_is_an_animation_of_both_views() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("wiggle.png");
    let (left, right) = (noise(20, 10, 3), noise(20, 10, 4));
    write_wiggle(&path, &Views { left: &left, right: &right }, 200).expect("written");
    let file = std::io::BufReader::new(fs::File::open(&path).expect("a file"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG file");
    let control = reader.info().animation_control.expect("animated");
    assert_eq!((control.num_frames, control.num_plays), (2, 0));
    let mut frame = vec![0; 20 * 10 * 3];
    for view in [&left, &right] {
        reader.next_frame(&mut frame).expect("a frame");
        let control = reader.info().frame_control.expect("timed");
        assert_eq!((control.delay_num, control.delay_den), (200, 1000));
        assert_eq!(&frame, view.as_raw());
    }
}

#[test]
fn a_failed_write_leaves_nothing_and_names_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    files::write(&file, b"content").expect("written");
    let taken = folder.path().join("taken.png");
    fs::create_dir(&taken).expect("a folder");
    let picture = noise(4, 4, 1);
    for path in [
        file.join("picture.png"),
        taken,
        Path::new("/proc/picture.png").to_owned(),
        Path::new("/").to_owned(),
    ] {
        let error = write_png(&path, &picture).expect_err("it cannot be").to_string();
        assert!(error.starts_with(&format!("{}: cannot be written: ", path.display())), "{error}");
    }
    assert_eq!(names(folder.path()), ["file", "taken.png"]);
    assert_eq!(fs::read(&file).expect("a file"), b"content");
}

#[test]
fn a_missing_folder_is_made() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("reports/today/report.json");
    files::write(&file, b"content").expect("written");
    assert_eq!(fs::read(&file).expect("a file"), b"content");
}

/// Not a test of its own: what the next one kills.
#[test]
#[ignore = "writes until it is killed"]
fn write_until_killed() {
    let Ok(folder) = std::env::var("WHEATSTONE_TEST_FOLDER") else {
        return;
    };
    for seed in 0.. {
        write_png(&Path::new(&folder).join("picture.png"), &noise(512, 512, seed))
            .expect("written");
    }
}

#[test]
fn a_killed_program_leaves_a_whole_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = std::env::current_exe().expect("this program");
    let path = folder.path().join("picture.png");
    for round in 0..10 {
        let _ = fs::remove_file(&path);
        let mut child = Command::new(&program)
            .args(["--exact", "picture::write_until_killed", "--ignored"])
            .env("WHEATSTONE_TEST_FOLDER", folder.path())
            .stdout(std::process::Stdio::null())
            .spawn()
            .expect("a child");
        // However slow it is: it is killed while it writes.
        while !path.exists() {
            assert!(child.try_wait().expect("a child").is_none(), "it ended by itself");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        std::thread::sleep(std::time::Duration::from_millis(7 * round));
        child.kill().expect("killed");
        child.wait().expect("gone");
        assert_eq!(image::open(&path).expect("a whole picture").width(), 512);
    }
    let stray = names(folder.path()).into_iter().filter(|n| n != "picture.png");
    assert!(stray.into_iter().all(|n| n.starts_with('.') && n.ends_with(".part")));
}
