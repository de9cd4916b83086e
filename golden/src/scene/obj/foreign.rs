//! Files of other kinds that are named like OBJ meshes, told by how they begin.

/// Beginnings in small letters, each with the kind of file that has it, and what to do with one.
const KINDS: [(&[u8], &str); 9] = [
    (b"\x1f\x8b", "a gzip archive; unpack it first"),
    (b"pk\x03\x04", "a ZIP archive; unpack it first"),
    (b"version https://git-lfs", "a pointer of Git LFS; fetch the file itself with git lfs pull"),
    (b"<!doctype", "an HTML page; download the file itself"),
    (b"<html", "an HTML page; download the file itself"),
    (b"ply\n", "a PLY mesh; save it as OBJ"),
    (b"ply\r", "a PLY mesh; save it as OBJ"),
    (b"solid ", "an STL mesh; save it as OBJ"),
    (b"solid\n", "an STL mesh; save it as OBJ"),
];

/// The kind of file, and what to do with it, if the first bytes tell.
pub fn kind(bytes: &[u8]) -> Option<&'static str> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let begins =
        |mark: &[u8]| text.get(..mark.len()).is_some_and(|first| first.eq_ignore_ascii_case(mark));
    KINDS.iter().find(|(mark, _)| begins(mark)).map(|(_, kind)| *kind)
}
