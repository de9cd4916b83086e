//! Conversion of meshes, materials and attributes.

use super::super::{open, Colours, Scene};
use crate::scene::Mesh;
use std::fs;

/// The scene of `m.obj` among some files, and the lines of its warnings without the folder.
fn loaded(files: &[(&str, &[u8])]) -> (Scene, Vec<String>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, content) in files {
        fs::write(folder.path().join(name), content).expect("written");
    }
    let scene = open(&folder.path().join("m.obj").display().to_string(), None, None);
    let scene = scene.expect("well-formed");
    let own = format!("{}/", folder.path().display());
    let warnings = scene.warnings.lines().iter().map(|line| line.replace(&own, "")).collect();
    (scene, warnings)
}

/// The mesh of a file alone.
fn mesh(text: &str) -> (Mesh, Vec<String>) {
    let (mut scene, warnings) = loaded(&[("m.obj", text.as_bytes())]);
    assert_eq!(scene.meshes.len(), 1);
    (scene.meshes.remove(0), warnings)
}

/// A black picture of one pixel.
fn picture(name: &str) -> (String, Vec<u8>) {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(1, 1).write_to(&mut bytes, image::ImageFormat::Bmp).expect("encoded");
    (name.into(), bytes.into_inner())
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const TEXTURED: &str = "usemtl m\nf 1/1 2/2 3/3 4/4\n";

#[test]
fn scale_and_offset_of_a_picture_are_followed_and_other_options_skipped() {
    let cases = [
        ("t.bmp", [1.0, 1.0], [0.0, 0.0], false),
        ("-s 2 3 1 t.bmp", [2.0, 3.0], [0.0, 0.0], false),
        ("-s 2 -o 0.5 0.25 t.bmp", [2.0, 1.0], [0.5, 0.25], false),
        ("-S 2 3 1 -O 0.5 T.BMP", [2.0, 3.0], [0.5, 0.0], false),
        ("-o .5 t.bmp", [1.0, 1.0], [0.5, 0.0], false),
        ("-mm 0 1 -clamp on -s 2 2 -blendu off \"t.bmp\"", [2.0, 2.0], [0.0, 0.0], true),
        ("-t 1 1 1 -texres 512 -imfchan r t.bmp", [1.0, 1.0], [0.0, 0.0], true),
        ("-s 2 2 2 2.bmp", [2.0, 2.0], [0.0, 0.0], false),
    ];
    let pictures = ["t.bmp", "2.bmp"].map(picture);
    for (map, scale, offset, warns) in cases {
        let material = format!("newmtl m\nmap_Kd {map}\n");
        let text = format!("mtllib m.mtl\n{SQUARE}{TEXTURED}");
        let mut files = vec![("m.obj", text.as_bytes()), ("m.mtl", material.as_bytes())];
        files.extend(pictures.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())));
        let (scene, warnings) = loaded(&files);
        assert_eq!(scene.textures.len(), 1, "{map}: {warnings:?}");
        assert_eq!(!warnings.is_empty(), warns, "{map}: {warnings:?}");
        let at = |u: f64, v: f64| [u * scale[0] + offset[0], 1.0 - (v * scale[1] + offset[1])];
        let points = &scene.meshes[0].texture_coordinates;
        assert_eq!(points, &[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)], "{map}");
    }
}

#[test]
fn colours_of_some_vertices_leave_the_others_white() {
    let text = "v 0 0 0 1 0 0.5 0.3\nv 1 0 0 2 -1 0\nv 1 1 0\nf 1 2 3\n";
    let (mesh, warnings) = mesh(text);
    assert!(warnings.is_empty(), "{warnings:?}");
    let colours = vec![[255, 0, 128], [255, 0, 0], [255, 255, 255]];
    assert_eq!(mesh.colours, Colours::Vertex(colours));
    // A face without colours keeps its material.
    let text = format!("mtllib m.mtl\n{text}v 2 2 0\nv 3 2 0\nv 3 3 0\nusemtl m\nf 4 5 6\n");
    let (scene, _) = loaded(&[("m.obj", text.as_bytes()), ("m.mtl", b"newmtl m\nKd 0 1 0\n")]);
    assert_eq!(scene.meshes[1].colours, Colours::Material);
    assert_eq!(scene.materials[scene.meshes[1].material as usize].diffuse, [0.0, 1.0, 0.0]);
}

#[test]
fn a_material_is_less_bright_the_lower_its_exponent_is() {
    let specular = |exponent: &str| {
        let material = format!("newmtl m\nKs 0.8 0.8 0.8\n{exponent}\n");
        let text = format!("mtllib m.mtl\n{SQUARE}usemtl m\nf 1 2 3\n");
        let files = [("m.obj", text.as_bytes()), ("m.mtl", material.as_bytes())];
        let (scene, warnings) = loaded(&files);
        assert!(warnings.is_empty(), "{warnings:?}");
        scene.materials[0].specular[0]
    };
    let cases =
        [("Ns 0", 0.0), ("Ns -1", 0.0), ("Ns 1", 0.0), ("Ns 5.5", 0.4), ("Ns 10", 0.8), ("", 0.8)];
    for (exponent, expected) in cases {
        assert_eq!(specular(exponent), expected, "{exponent}");
    }
}

#[test]
fn a_normal_that_is_no_direction_is_replaced_by_the_faces_own() {
    for (normal, warns) in [("0 0 0", false), ("nan 0 1", true), ("0 -inf 0", true)] {
        let text = format!("{SQUARE}vn 3 0 0\nvn {normal}\nf 1//1 2//2 3//2 4//1\n");
        let (mesh, warnings) = mesh(&text);
        assert_eq!(!warnings.is_empty(), warns, "{warnings:?}");
        let own = [0.0, 0.0, -1.0];
        assert_eq!(mesh.normals, [[1.0, 0.0, 0.0], own, own, [1.0, 0.0, 0.0]].to_vec());
    }
}

#[test]
fn names_are_resolved_at_the_end_and_in_any_encoding() {
    // Vertices after the face that has them; a library at the end; é of Latin-1; no name.
    let text = b"usemtl caf\xe9 # 1\nf 1 2 3\nusemtl\nf 3 2 1\nv 0 0 0\nv 1 0 0\nv 1 1 0\n\
        mtllib a.mtl my b.mtl\nmtllib a.mtl\n";
    let a = b"newmtl caf\xe9\nKd .5\nnewmtl\nKd 0 0 1\n";
    let b = b"newmtl caf\xe9\nKd 1 1 1\n";
    let (scene, warnings) = loaded(&[("m.obj", text), ("a.mtl", a), ("my b.mtl", b)]);
    let diffuse = |k: usize| scene.materials[scene.meshes[k].material as usize].diffuse;
    assert_eq!((diffuse(0), diffuse(1)), ([0.5; 3], [0.0, 0.0, 1.0]));
    let expected = "my b.mtl:1: newmtl café: the material is there already; the first counts";
    assert_eq!(warnings, [expected]);
}

#[test]
fn names_may_have_quotes_on_either_side() {
    let text = format!("mtllib m.mtl\n{SQUARE}usemtl \"a\"\nf 1 2 3\nusemtl b c\nf 1 3 4\n");
    let library = b"newmtl a\nKd 1 0 0\nnewmtl 'b c'\nKd 0 1 0\n";
    let (scene, warnings) = loaded(&[("m.obj", text.as_bytes()), ("m.mtl", library)]);
    assert_eq!(warnings, [""; 0]);
    let diffuse = |k: usize| scene.materials[scene.meshes[k].material as usize].diffuse;
    assert_eq!((diffuse(0), diffuse(1)), ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
}

#[test]
fn names_may_have_comments_on_either_side() {
    let library = b"newmtl a # red\nKd 1 0 0\nnewmtl b #2\nKd 0 1 0\nnewmtl b\nKd 0 0 1\n";
    let faces = ["a", "a # once more", "b", "b # blue", "b #2"];
    let faces = faces.map(|name| format!("usemtl {name}\nf 1 2 3\n")).concat();
    let text = format!("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}");
    let (scene, told) = loaded(&[("m.obj", text.as_bytes()), ("m.mtl", library)]);
    assert_eq!(told, [""; 0]);
    let colour = |mesh: &Mesh| scene.materials[mesh.material as usize].diffuse;
    let colours: Vec<_> = scene.meshes.iter().map(colour).collect();
    assert_eq!(colours, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
}

#[test]
fn a_library_that_is_none_is_one_warning() {
    let text = format!("mtllib notes.txt\n{SQUARE}usemtl m\nf 1 2 3\n");
    let told =
        |notes: &str| loaded(&[("m.obj", text.as_bytes()), ("notes.txt", notes.as_bytes())]).1;
    let lines = told(&"some words\n".repeat(50));
    let expected = "m.obj:1: mtllib notes.txt: no library of materials, as it has no newmtl; drawn light grey \
                    (50 other statements)";
    assert_eq!(lines, [expected]);
    let lines = told(&("some words\n".repeat(50) + "newmtl m\n"));
    assert_eq!(lines, ["notes.txt:1: some words: newmtl comes first; left out (as 49 more)"]);
}

#[test]
fn texture_points_that_cannot_be_used_leave_the_face_without_texture() {
    let (name, bytes) = picture("t.bmp");
    for (point, told) in [("vt 5000 0", "m.obj:12: f: more than 1024"), ("vt nan", "m.obj:10: vt")]
    {
        let text = format!("mtllib m.mtl\n{SQUARE}{point}\nusemtl m\nf 1/1 2/5 3/3\n");
        let files: [(&str, &[u8]); 3] =
            [("m.obj", text.as_bytes()), ("m.mtl", b"newmtl m\nmap_Kd t.bmp\n"), (&name, &bytes)];
        let (scene, warnings) = loaded(&files);
        assert!(scene.meshes[0].texture_coordinates.is_empty());
        assert!(warnings.len() == 1 && warnings[0].starts_with(told), "{warnings:?}");
    }
}

#[test]
fn it_is_known_how_far_a_file_is_read() {
    let mut told = Vec::new();
    let text = "v 1 2 3\n# comment\n\nv 4 5 6\nf 1 2 3";
    let listen = |_: &super::statement::Statement| {
        let own = |text: &String| text.contains("read slowly.obj");
        told.extend(crate::progress::all().into_iter().filter(own));
        Ok::<(), ()>(())
    };
    super::statement::each("a/read slowly.obj".as_ref(), text, listen).expect("no error");
    let line = |n: u32| format!("reading a/read slowly.obj: {n} lines so far");
    assert_eq!(told, [0, 3, 4].map(line));
}
