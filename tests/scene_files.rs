//! Scene, mesh, material and rig files: what they become, and what is said of broken ones.

use std::fs;
use std::path::{Path, PathBuf};
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Formats, Rgba};
use wheatstone_golden::picture::{write_png, Rgb, RgbImage};
use wheatstone_golden::scene::{json, open, Cull, Geometry, Options, Rig, Scene, Source};

const WIDE: Formats = Formats::new(&Config::DEFAULT);

/// A folder that goes when it is dropped.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().expect("a temporary folder"))
    }

    fn put(&self, name: &str, content: &str) -> PathBuf {
        let path = self.0.path().join(name);
        fs::create_dir_all(path.parent().expect("it has one")).expect("a folder");
        fs::write(&path, content).expect("written");
        path
    }
}

fn load(path: &Path) -> Result<Scene, String> {
    open(&path.display().to_string(), None, None).map_err(|e| e.to_string())
}

fn geometry(scene: &Scene, cull: Cull) -> Geometry {
    scene.geometry(&WIDE, &Options { cull, ..Options::default() }).expect("the scene is legal")
}

const GOOD: &str = r#"{
"format": "stereo-scene/1",
"width": 64,
"height": 48,
"pixels_per_unit": 10,
"eye_separation": 1,
"viewing_distance": 10,
"background": [0, 0, 0],
"vertices": [[0, 0, 0], [1, 0, 0],
             [0, 1, 0]],
"colors": [[1, 2, 3], [4, 5, 6], [7, 8, 9]],
"triangles": [[0, 1, 2],
              [2, 1, 0]],
"triangle_colors": [[1, 1, 1], [2, 2, 2]],
"near": 1,
"far": 100
}"#;

#[test]
fn broken_scene_files_are_refused_by_line_and_field() {
    assert!(json::scene(Path::new("s.json"), GOOD).is_ok());
    // What to replace by what, and what the error must say.
    let cases: &[(&str, &str, &[&str])] = &[
        ("\"width\": 64,", "", &["s.json", "width", "missing"]),
        ("\"colors\"", "\"colours\"", &[":11", "colours", "expected one of", "`colors`"]),
        ("\"far\": 100", "\"far\": 100, \"fog\": 1", &[":16", "fog", "unknown field"]),
        ("\"near\": 1", "\"width\": 1", &[":15", "width", "duplicate"]),
        ("stereo-scene/1", "stereo-scene/2", &[":2", "format", "stereo-scene/1", "stereo-scene/2"]),
        ("\"stereo-scene/1\"", "1", &[":2: format: expected \"stereo-scene/1\", found 1"]),
        ("64", "0", &[":3: width: expected 1 to 2048 pixels, found 0"]),
        ("48", "2049", &[":4: height: expected 1 to 2048 pixels, found 2049"]),
        ("48", "-1", &[":4: height: expected a whole number from 0, found integer `-1`"]),
        ("64", "\"64\"", &[":3: width: expected a whole number from 0, found string"]),
        ("64", "64.5", &[":3: width", "64.5"]),
        ("_unit\": 10", "_unit\": 0", &[":5: pixels_per_unit", "found 0"]),
        ("_unit\": 10", "_unit\": null", &[":5: pixels_per_unit", "null"]),
        ("separation\": 1", "separation\": -1", &[":6: eye_separation", "found -1"]),
        ("distance\": 10", "distance\": 1e300", &[":7: viewing_distance"]),
        ("\"near\": 1,", "\"near\": 100,", &[":16: far: expected more than near, which is 100"]),
        ("\"near\": 1,", "\"near\": -1,", &[":15: near"]),
        ("[0, 0, 0],\n\"v", "[0, 0, 256],\n\"v", &[":8: background[2]", "0 to 255", "256"]),
        ("[4, 5, 6]", "[4, -5, 6]", &[":11: colors[1][1]", "0 to 255", "-5"]),
        ("[4, 5, 6]", "[4, 5.5, 6]", &[":11: colors[1][1]", "0 to 255", "5.5"]),
        ("[4, 5, 6]", "[4, 5]", &[":11: colors[1]", "length 2"]),
        ("[4, 5, 6]", "[4, 5, 6, 7]", &[":11: colors[1]", "3 elements", "more"]),
        (", [7, 8, 9]]", "]", &[":11: colors: expected one a vertex, 3, found 2"]),
        ("[0, 1, 0]]", "[0, \"1\", 0]]", &[":10: vertices[2][1]", "string"]),
        ("[0, 1, 0]]", "[0, NaN, 0]]", &[":10: vertices[2]"]),
        ("[0, 1, 0]]", "[0, 1e999, 0]]", &[":10: vertices[2][1]", "number out of range"]),
        ("[0, 1, 0]]", "[0, 2e9, 0]]", &[":10: vertices[2]: expected finite", "1e9"]),
        ("[2, 1, 0]]", "[2, 1, 3]]", &[":13: triangles[1]: expected indices of 3", "[2, 1, 3]"]),
        ("[2, 1, 0]]", "[2, 1, -1]]", &[":13: triangles[1][2]", "-1"]),
        ("[2, 1, 0]]", "[2, 1]]", &[":13: triangles[1]"]),
        (", [2, 2, 2]]", "]", &[":14: triangle_colors: expected one a triangle, 2, found 1"]),
        ("[2, 2, 2]", "[2, 2, 1000]", &[":14: triangle_colors[1][2]", "1000"]),
        ("\"far\": 100\n}", "\"far\": 100", &["well-formed JSON", "EOF"]),
        ("\"far\": 100\n}", "\"far\": 100\n} 5", &[":17", "well-formed JSON", "trailing"]),
        ("\"near\": 1,", "\"near\": 1", &[":16", "well-formed JSON"]),
        ("{\n\"format\"", "[\n\"format\"", &["s.json"]),
    ];
    for (from, to, texts) in cases {
        assert!(GOOD.contains(from), "{from}");
        let text = GOOD.replacen(from, to, 1);
        let Err(error) = json::scene(Path::new("s.json"), &text) else {
            panic!("{to} was accepted");
        };
        let error = error.to_string();
        for text in *texts {
            assert!(error.contains(text), "{to}: “{error}” does not say “{text}”");
        }
        assert!(error.starts_with("s.json") && !error.contains('\n'), "{error}");
    }
    for text in ["", "5", "null", "[]", "{}", "\u{1f600}"] {
        assert!(json::scene(Path::new("s.json"), text).is_err(), "{text}");
    }
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let error = |name: &str| open(name, None, None).unwrap_err().to_string();
    for name in ["/no/such/scene.json", "/no/such/mesh.obj"] {
        assert!(error(name).starts_with(&format!("{name}: cannot be read: ")), "{}", error(name));
    }
    let unknown = error("teapto");
    assert!(
        unknown.contains("teapto") && unknown.contains("teapot, room, village, atoms"),
        "{unknown}"
    );
    assert!(error("mesh.stl").contains(".obj, .json, .png, .txt or .grid"));
    let missing = open("teapot", None, Some(Path::new("/no/rig.json"))).unwrap_err().to_string();
    assert!(missing.starts_with("/no/rig.json: cannot be read"), "{missing}");
    let folder = Folder::new();
    let path = folder.0.path().join("latin.json");
    fs::write(&path, b"{\n\"format\": \"\xe9\"}").expect("written");
    assert!(load(&path).unwrap_err().contains("latin.json:2: file: expected UTF-8"));
}

const MESH: &str = "# a comment
mtllib m.mtl
v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 0
vt 0 0
vt 1 1
vn 0 0 1
usemtl red
f 1/1/1 2/2/1 3/1/1 4/2/1
f -4 -3 -2
";
const MATERIALS: &str = "newmtl red
Kd 1 0 0
Ks 0.5 0.5 0.5
Ns 20
illum 3
newmtl glass
Kd 0 0 1
Tr 0.25
map_Kd picture.png
";

#[test]
fn broken_meshes_are_refused_by_line_and_field() {
    let cases: &[(&str, &str, &[&str])] = &[
        ("v 2 1 0", "v 2 1", &["mesh.obj:5: v: expected at least 3 numbers, found 2"]),
        ("v 2 1 0", "v 2 x 0", &["mesh.obj:5: v: expected a number, found x"]),
        ("v 2 1 0", "v 2 1,5 0", &["mesh.obj:5: v: expected a number, found 1,5"]),
        ("v 2 1 0", "v 2 NaN 0", &["mesh.obj:5: v: expected finite coordinates", "NaN"]),
        ("v 2 1 0", "v 2 inf 0", &["mesh.obj:5: v: expected finite coordinates", "inf"]),
        ("v 2 1 0", "v 2 1.#QNAN 0", &["mesh.obj:5: v: expected finite coordinates", "1.#QNAN"]),
        ("v 2 1 0", "v 2 1e10 0", &["mesh.obj:5: v: expected finite coordinates", "1e10"]),
        ("vt 1 1", "vt", &["mesh.obj:8: vt: expected at least 1 number, found 0"]),
        ("vt 1 1", "vt 1 x", &["mesh.obj:8: vt: expected a number, found x"]),
        ("vn 0 0 1", "vn 0 0", &["mesh.obj:9: vn: expected at least 3 numbers, found 2"]),
        ("f -4 -3 -2", "f 1 2 5", &["mesh.obj:12: f: expected an index of the 4 vertices", "5"]),
        ("f -4 -3 -2", "f 0 1 2", &["mesh.obj:12: f", "found 0"]),
        ("f -4 -3 -2", "f -5 1 2", &["mesh.obj:12: f: expected an index of the 4 vertices so far"]),
        ("f -4 -3 -2", "f 1 2 5000000000", &["mesh.obj:12: f", "found 5000000000"]),
        (
            "f -4 -3 -2",
            "f 1 2 99999999999999999999",
            &["mesh.obj:12: f: expected an index of the 4 vertices so far, found 99999999999999999999, which is too large"],
        ),
        ("f -4 -3 -2", "f 1/1/1/1 2 3", &["mesh.obj:12: f: expected vertex/texture/normal"]),
        ("f -4 -3 -2", "f /1 2 3", &["mesh.obj:12: f: expected the index of a vertex"]),
        ("f -4 -3 -2", "f 1.5 2 3", &["mesh.obj:12: f: expected whole numbers", "1.5"]),
    ];
    let folder = Folder::new();
    folder.put("m.mtl", MATERIALS);
    for (from, to, texts) in cases {
        assert!(MESH.contains(from), "{from}");
        let path = folder.put("mesh.obj", &MESH.replacen(from, to, 1));
        let error = load(&path).expect_err(to);
        for text in *texts {
            assert!(error.contains(text), "{to}: “{error}” does not say “{text}”");
        }
    }
    for text in ["", "v 0 0 0\nv 1 0 0\n", "# <html>\n"] {
        let error = load(&folder.put("empty.obj", text)).expect_err(text);
        assert!(error.contains("empty.obj: f: expected at least one face, found "), "{error}");
    }
    for (text, said) in [
        ("# a\nOFF\n3 1 0\n", "empty.obj:2: off: expected a statement of OBJ files, found another"),
        ("v 0 0 0\nface 1\n", "empty.obj:2: face: expected a statement"),
        ("\0\u{1}\u{2}", "empty.obj:1: \u{fffd}\u{fffd}\u{fffd}: expected a statement"),
        ("\n <!DOCTYPE html>\n", "empty.obj:1: file: expected an OBJ mesh, found an HTML page"),
        ("<HTML>\nv x\n", "found an HTML page; download the file itself"),
        ("version https://git-lfs.github.com/spec/v1\n", "found a pointer of Git LFS"),
        ("ply\r\nformat ascii 1.0\n", "found a PLY mesh; save it as OBJ"),
        ("solid a\nfacet normal 0 0 1\n", "found an STL mesh; save it as OBJ"),
    ] {
        let error = load(&folder.put("empty.obj", text)).expect_err(text);
        assert!(error.contains(said), "{error}");
    }
    let path = folder.put("packed.obj", "");
    fs::write(&path, b"\x1f\x8b\x08\0\0v\n").expect("written");
    assert!(load(&path)
        .expect_err("packed")
        .contains("packed.obj:1: file: expected an OBJ mesh, found a gzip"));
    // What can be read is read.
    load(&folder.put("solid.obj", "solid a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))
        .expect("a mesh");
    for (line, said) in [
        ("l 1", "l: expected at least two points, found 1, and the file has nothing else"),
        (
            "p 1\nf 1 1",
            "f: expected at least three corners, found 2, and the file has nothing else",
        ),
    ] {
        let text = format!("v 0 0 0\n{line}\nl\n");
        let error = load(&folder.put("short.obj", &text)).expect_err(line);
        let at = 1 + line.lines().count();
        assert!(error.contains(&format!("short.obj:{at}: {said}")), "{error}");
    }
    for (bytes, name) in [(b"\xff\xfev\0 \0", "UTF-16"), (b"v\0\0\0 \0", "UTF-32")] {
        let path = folder.put("wide.obj", "");
        fs::write(&path, bytes).expect("written");
        let error = load(&path).expect_err(name);
        assert!(
            error.contains("wide.obj: file: expected UTF-8 text, found ") && error.contains(name)
        );
    }
}

/// The one warning of a scene.
fn warning(scene: &Scene) -> String {
    let lines = scene.warnings.lines();
    assert_eq!(lines.len(), 1, "{lines:?}");
    lines.into_iter().next().unwrap_or_default()
}

#[test]
fn what_is_not_followed_is_a_warning_with_file_and_line() {
    let cases: &[(&str, &str, &str)] = &[
        ("v 2 1 0", "v 2 1 0 0", "mesh.obj:5: v 2 1 0 0: w makes the place infinite"),
        ("v 2 1 0", "v 2 1 0 1 1", "mesh.obj:5: v 2 1 0 1 1: neither 3, 4, 6 nor 7 numbers"),
        ("v 2 1 0", "v 2 1 0 1 nan 1", "mesh.obj:5: v 2 1 0 1 nan 1: the colour is not finite"),
        ("vt 1 1", "vt inf", "mesh.obj:8: vt inf: not finite"),
        ("vn 0 0 1", "vn 0 -nan(ind) 1", "mesh.obj:9: vn 0 -nan(ind) 1: not finite"),
        ("f -4 -3 -2", "f 1 2", "mesh.obj:12: f 1 2: fewer than three corners"),
        ("f -4 -3 -2", "f 1/3 2/1 3/1", "mesh.obj:12: f: no such texture point"),
        ("f -4 -3 -2", "f 1/99999999999999999999 2/1 3/1", "mesh.obj:12: f: no such texture"),
        ("f -4 -3 -2", "f 1/0 2/1 3/1", "mesh.obj:12: f: no such texture point"),
        ("f -4 -3 -2", "f 1//2 2//1 3//1", "mesh.obj:12: f: no such normal"),
        ("f -4 -3 -2", "f 1/1 2 3", "mesh.obj:12: f: texture points at some corners alone"),
        ("f -4 -3 -2", "f 1//1 2 3", "mesh.obj:12: f: normals at some corners alone"),
        ("f -4 -3 -2", "F 1 2 3\np 1", "mesh.obj:13: p 1: not drawn"),
        ("f -4 -3 -2", "fo 1 2 3\nface 1", "mesh.obj:13: face 1: no statement of OBJ"),
        ("mtllib m.mtl", "mtllib n.mtl", "mesh.obj:2: mtllib n.mtl: no such library"),
        ("mtllib m.mtl", "mtllib m.mtl n.mtl", "mesh.obj:2: mtllib n.mtl: no such library"),
        ("mtllib m.mtl", "mtllib m.mtl\nmtllib", "mesh.obj:3: mtllib: no library is named"),
        ("usemtl red", "usemtl blue", "mesh.obj:10: usemtl blue: no such material"),
        ("mtllib m.mtl\n", "", "mesh.obj:9: usemtl red: no such material"),
        ("usemtl red", "usemtl glass", "m.mtl:9: map_Kd picture.png: no such picture"),
        ("Kd 1 0 0", "Kd 1 0", "m.mtl:2: Kd 1 0: neither one nor three"),
        ("Kd 1 0 0", "Kd spectral x.rfl", "m.mtl:2: Kd spectral x.rfl: neither one nor three"),
        ("Kd 1 0 0", "Kd nan nan nan", "m.mtl:2: Kd nan nan nan: neither one nor three"),
        ("Ns 20", "Ns shiny", "m.mtl:4: Ns shiny: no finite number"),
        (
            "map_Kd picture.png",
            "map_Kd -clamp on picture.png",
            "m.mtl:9: map_Kd -clamp on picture.png: an option that is not followed (-clamp)",
        ),
        ("Ns 20", "Ns 20\nmap_d", "m.mtl:5: map_d: no picture is named"),
        ("Ns 20", "Ns 20\nshine 7", "m.mtl:5: shine 7: no statement of MTL"),
        ("Tr 0.25", "d 1.5", "m.mtl:8: d 1.5: not from 0 to 1"),
        ("illum 3", "illum x", "m.mtl:5: illum x: no finite number"),
        ("newmtl red\n", "Kd 1 1 1\nnewmtl red\n", "m.mtl:1: Kd 1 1 1: newmtl comes first"),
        ("newmtl glass", "newmtl red", "m.mtl:6: newmtl red: the material is there already"),
        ("map_Kd picture.png", "map_Kd", "m.mtl:9: map_Kd: no picture is named"),
        (
            "map_Kd picture.png",
            "map_Kd -clamp on a.png",
            "m.mtl:9: map_Kd -clamp on a.png: an option",
        ),
    ];
    let folder = Folder::new();
    for (from, to, text) in cases {
        assert!(MESH.contains(from) || MATERIALS.contains(from), "{from}");
        let path = folder.put("mesh.obj", &MESH.replacen(from, to, 1));
        folder.put("m.mtl", &MATERIALS.replacen(from, to, 1));
        let said = warning(&load(&path).expect(to));
        let place = folder.0.path().join(text).display().to_string();
        assert!(said.starts_with(&place), "{to}: {said}");
    }
    // A library in another encoding, and one that is a folder.
    fs::write(folder.0.path().join("m.mtl"), b"n\0e\0w\0").expect("written");
    let path = folder.put("mesh.obj", MESH);
    let said = warning(&load(&path).expect("drawn without"));
    assert!(
        said.contains("mesh.obj:2: mtllib m.mtl: no readable library") && said.contains("UTF-16")
    );
}

#[test]
fn pictures_that_cannot_be_used_are_warnings() {
    let folder = Folder::new();
    folder.put("m.mtl", MATERIALS);
    folder.put("picture.png", "not a picture");
    let path = folder.put("mesh.obj", &MESH.replace("usemtl red", "usemtl glass"));
    let scene = load(&path).expect("drawn in the colour of Kd");
    let said = warning(&scene);
    let expected =
        "m.mtl:9: map_Kd picture.png: the picture cannot be used; drawn in the colour of \
        Kd (expected PNG, JPEG, BMP, TGA or WebP)";
    assert!(said.ends_with(expected), "{said}");
    assert_eq!(scene.materials[0].diffuse, [0.0, 0.0, 1.0]);
    assert_eq!((scene.textures.len(), scene.materials[0].texture), (0, None));
}

#[test]
fn meshes_are_centred_fitted_and_face_the_viewer() {
    let folder = Folder::new();
    folder.put("m.mtl", MATERIALS);
    let scene = load(&folder.put("mesh.obj", MESH)).expect("well-formed");
    let seen = geometry(&scene, Cull::Back);
    // The quad and the triangle: two and one, of one id each.
    assert_eq!(seen.polygons.iter().map(|p| p.id).collect::<Vec<_>>(), [0, 0, 1]);
    // 80 % of 480 pixels wide, half as high, about the middle.
    let vertices = || seen.polygons.iter().flat_map(|p| &p.vertices);
    let columns = || vertices().map(|v| v.x[0]);
    let rows = || vertices().map(|v| v.y[0]);
    assert_eq!((columns().min(), columns().max()), (Some(128 * 256), Some(512 * 256)));
    assert_eq!((rows().min(), rows().max()), (Some(144 * 256), Some(336 * 256)));
    let colour = seen.polygons[0].vertices[0].colour[0].0;
    assert!(colour[0] > 120 && colour[3] == 255, "{colour:?}");
    assert!(scene.materials[0].reflection[0] > 0.0 && scene.materials[0].exponent == 20);
    // The other way round it is a back face.
    let back = load(&folder.put("back.obj", &MESH.replace("f -4 -3 -2", "f -2 -3 -4")));
    let seen = geometry(&back.expect("well-formed"), Cull::Back);
    assert_eq!((seen.polygons.len(), seen.counts.culled), (2, 1));
    // What has a larger z in the file is nearer.
    let tall = "v 0 0 0\nv 1 0 1\nv 0 1 -1\nf 1 2 3\n";
    let seen = geometry(&load(&folder.put("tall.obj", tall)).expect("well-formed"), Cull::None);
    let depths: Vec<u32> = seen.polygons[0].vertices.iter().map(|v| v.depth).collect();
    assert!(depths[1] < depths[0] && depths[0] < depths[2]);
    let vertices = &seen.polygons[0].vertices;
    assert!(vertices[1].x[0] > vertices[1].x[1] && vertices[2].x[0] < vertices[2].x[1]);
}

#[test]
fn materials_textures_and_colours_reach_the_polygons() {
    let folder = Folder::new();
    folder.put("sub/m.mtl", &MATERIALS.replace("picture.png", "pictures\\a b.png"));
    fs::create_dir(folder.0.path().join("sub/pictures")).expect("a folder");
    let mut picture = RgbImage::from_pixel(4, 2, Rgb([9, 9, 9]));
    picture.put_pixel(3, 0, Rgb([200, 100, 50]));
    write_png(&folder.0.path().join("sub/pictures/a b.png"), &picture).expect("written");
    let mesh = MESH.replace("m.mtl", "sub/m.mtl").replace("usemtl red", "usemtl\tglass");
    let scene = load(&folder.put("mesh.obj", &mesh)).expect("well-formed");
    assert_eq!((scene.textures[0].width, scene.textures[0].height), (4, 2));
    assert_eq!(scene.textures[0].texels[3], Rgba([200, 100, 50, 255]));
    let seen = geometry(&scene, Cull::None);
    let textured = &seen.polygons.iter().find(|p| p.id == 0).expect("the quad");
    assert_eq!(textured.texture, Some(0));
    // The lower left corner of the picture, then its upper right one.
    let texels: Vec<[i32; 2]> = textured.vertices.iter().map(|v| v.texel).collect();
    assert_eq!(texels[0], [0, 512]);
    assert_eq!(texels[1], [1024, 0]);
    assert!(textured.vertices.iter().all(|v| v.colour[0].0[3] == 191));
    // The triangle has no texture coordinates.
    assert_eq!(seen.polygons.iter().find(|p| p.id == 1).expect("it").texture, None);

    let coloured = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nusemtl none\nf 1 2 3\n";
    let scene = load(&folder.put("coloured.obj", coloured)).expect("well-formed");
    let seen = geometry(&scene, Cull::Back);
    let colours = seen.polygons[0].vertices.iter().map(|v| v.colour[0].0);
    let lit: Vec<[u8; 4]> = colours.collect();
    assert!(lit[0][0] > 100 && lit[0][1] == 0 && lit[1][1] > 100 && lit[2][2] > 50, "{lit:?}");
}

#[test]
fn faces_of_all_layouts_and_continued_lines_are_read() {
    let folder = Folder::new();
    let text = "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0 # corner\nv 0 1 \\\n 0\nvn 0 0 1\nvt 0.5\n\
        g b\nl 1 2\nf 1 2 3\nf 1//1 2//1 3//1\nf 1/1 2/1 3/1\nf 1/1/1 3/1/1 4/1/-1\ns off\nf 1 2 3 4\n";
    let scene = load(&folder.put("mixed.obj", text)).expect("well-formed");
    let triangles: usize = scene.meshes.iter().map(|m| m.triangles.len()).sum();
    assert_eq!(triangles, 8);
    let seen = geometry(&scene, Cull::Back);
    // Faces, then the line.
    let ids: Vec<u32> = seen.polygons.iter().map(|p| p.id).collect();
    assert_eq!(ids, [0, 1, 2, 3, 4, 4, 5, 5]);
    assert!(scene.meshes.iter().all(|m| m.normals.iter().all(|n| *n == [0.0, 0.0, -1.0])));
}

#[test]
fn rig_files_move_the_eyes_and_the_mesh() {
    let folder = Folder::new();
    let mesh =
        folder.put("mesh.obj", &MESH.replace("mtllib m.mtl\n", "").replace("usemtl red\n", ""));
    let mesh = mesh.display().to_string();
    let rig = folder.put(
        "rig.json",
        r#"{"width": 320, "height": 240, "eye_separation": 3, "viewing_distance": 80,
            "background": [1, 2, 3], "head_tilt": 5, "near": 2,
            "placement": {"rotation": [0, 90, 0], "fit": 0.5, "offset": [1, 2, 3]},
            "light": {"direction": [0, 0, -1], "ambient": [0, 0, 0]}}"#,
    );
    let scene = open(&mesh, None, Some(&rig)).expect("well-formed");
    assert_eq!((scene.width, scene.height, scene.background), (320, 240, [1, 2, 3]));
    let expected = Rig {
        pixels_per_unit: 10.0,
        eye_separation: 3.0,
        viewing_distance: 80.0,
        near: Some(2.0),
        far: None,
        head_tilt: 5.0,
        ..Rig::default()
    };
    assert_eq!(scene.rig, expected);
    let lighting = scene.lighting.expect("it is lit");
    assert_eq!(lighting.lights[0].source, Source::Direction([0.0, 0.0, -1.0]));
    assert_eq!((lighting.lights[0].colour, lighting.ambient), ([0.8; 3], [0.0; 3]));
    // Half of 24 units, turned so that the mesh's x points away from the viewer.
    let places: Vec<[f64; 3]> = scene.meshes.iter().flat_map(|m| m.positions.clone()).collect();
    let least = |k: usize| places.iter().fold(f64::MAX, |m, p| m.min(p[k]));
    let most = |k: usize| places.iter().fold(f64::MIN, |m, p| m.max(p[k]));
    assert_eq!([least(0), most(0)], [1.0, 1.0]);
    assert_eq!([least(1), most(1)], [-1.0, 5.0]);
    assert_eq!([least(2), most(2)], [-3.0, 9.0]);
    assert_eq!(places[0], [1.0, -1.0, -3.0]);

    let free = folder.put("free.json", r#"{"placement": {"fit": null, "offset": [0, 0, 5]}}"#);
    let scene = open(&mesh, Some([1280, 960]), Some(&free)).expect("well-formed");
    assert_eq!(scene.rig, Rig { pixels_per_unit: 40.0, ..Rig::default() });
    assert_eq!(scene.meshes[0].positions[1], [2.0, 0.0, 5.0]);
    // The size given on the command line goes first; built-in scenes take rigs too.
    let scene = open("teapot", Some([64, 48]), Some(&rig)).expect("there is one");
    assert_eq!((scene.width, scene.rig.pixels_per_unit, scene.rig.eye_separation), (64, 2.0, 3.0));
}

#[test]
fn broken_rig_files_are_refused() {
    let cases: &[(&str, &[&str])] = &[
        (r#"{"eye_seperation": 6}"#, &["rig.json:1", "eye_seperation", "unknown field"]),
        ("{\n\"width\": 0, \"height\": 9}", &["rig.json:2: width: expected 1 to 2048"]),
        ("{\n\"width\": 10}", &["rig.json:2: width: expected width and height"]),
        (r#"{"width": 4000, "height": 9}"#, &["width", "4000"]),
        ("{\n\n\"viewing_distance\": 0}", &["rig.json:3: viewing_distance", "found 0"]),
        (r#"{"near": 1, "far": 1}"#, &["far: expected more than near"]),
        (r#"{"near": 6000}"#, &["rig.json:1: near: expected less than far, which is 6000"]),
        (
            r#"{"viewing_distance": 1e-9}"#,
            &["rig.json:1: viewing_distance: expected one with near, a hundredth of it, a number from 1e-9", "found 0.000000001"],
        ),
        (
            r#"{"viewing_distance": 1e8}"#,
            &["rig.json:1: viewing_distance: expected one with far, a hundred times it, a number"],
        ),
        (r#"{"head_tilt": 400}"#, &["head_tilt", "180"]),
        (r#"{"pixels_per_unit": "many"}"#, &["pixels_per_unit", "string"]),
        (r#"{"background": [0, 0, 300]}"#, &["background[2]", "300"]),
        ("{\"placement\":\n{\"fit\": 0}}", &["rig.json:2: placement.fit"]),
        (r#"{"placement": {"spin": 1}}"#, &["placement", "spin", "unknown field"]),
        (r#"{"placement": {"rotation": [0, 1e5, 0]}}"#, &["placement.rotation"]),
        (r#"{"light": {"direction": [0, 0, 0]}}"#, &["light.direction: expected a direction"]),
        (r#"{"light": {"colour": [0, -1, 0]}}"#, &["light.colour"]),
        ("{", &["rig.json:1", "well-formed JSON"]),
        ("", &["well-formed JSON"]),
    ];
    let folder = Folder::new();
    for (text, parts) in cases {
        let rig = folder.put("rig.json", text);
        let error = open("teapot", None, Some(&rig)).map(|_| ()).expect_err(text).to_string();
        for part in *parts {
            assert!(error.contains(part), "{text}: “{error}” does not say “{part}”");
        }
    }
    // No field is blamed that nobody wrote.
    let mesh = folder.put("far.obj", "v 1e9 1e9 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\n");
    let rig = folder.put("rig.json", "{\"placement\": {\"rotation\": [0, 0, 45],\n\"fit\": null}}");
    let opened = open(&mesh.display().to_string(), None, Some(&rig));
    let error = opened.map(|_| ()).expect_err("too far").to_string();
    let said = "rig.json:2: placement.fit: expected what puts no coordinate of the mesh beyond 1e9, found null";
    assert!(error.ends_with(said), "{error}");
}
