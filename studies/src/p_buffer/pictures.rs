//! The publication's pictures: what each method shows, and where it is wrong.

use super::measure::{Office, Step, MOVES};
use super::published::{ROOMS, SIZE};
use crate::StudyError;
use std::path::{Path, PathBuf};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::picture::{frame_picture, side_by_side, write_png, RgbImage};
use wheatstone_golden::visibility::warping::wrong_picture;
use wheatstone_golden::visibility::Pose;

/// Writes all of them; returns their names.
pub fn write(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let mut files = Vec::new();
    let mut save = |name: &str, pictures: &[RgbImage]| {
        let file = folder.join(name);
        let row: Vec<&RgbImage> = pictures.iter().collect();
        write_png(&file, &side_by_side(&row))?;
        files.push(file);
        Ok::<(), StudyError>(())
    };
    let office = Office::of_rooms(ROOMS)?;
    let pair = office.other_eye();
    save("p_buffer_pair.png", &[frame_picture(&pair.p_buffer), frame_picture(&pair.source)])?;
    save("p_buffer_pair_errors.png", &errors(&pair))?;
    let moved = office.moved(&Pose::default(), &MOVES[0]);
    save("p_buffer_moved.png", &[frame_picture(&moved.source), frame_picture(&moved.truth)])?;
    save(
        "p_buffer_moved_methods.png",
        &[frame_picture(&moved.p_buffer), frame_picture(&moved.warped.frame)],
    )?;
    save("p_buffer_moved_errors.png", &errors(&moved))?;
    for name in ["perception-cylinder", "perception-solid"] {
        let scene = Office::new(name, [SIZE * 4 / 3, SIZE])?;
        let [left, right] = Eye::BOTH.map(|eye| scene.full(scene.eyes[eye as usize]));
        let without = scene.from_visible(&left, scene.eyes[Eye::Right as usize]);
        let name = format!("{}.png", name.replace('-', "_"));
        save(&name, &[left, right, without].map(|frame| frame_picture(&frame)))?;
    }
    Ok(files)
}

/// Pictures of the errors of the P-buffer's and of the warped view.
fn errors(step: &Step) -> [RgbImage; 2] {
    [wrong_picture(&step.p_buffer, &step.truth), step.warped.fault_picture(&step.truth)]
}
