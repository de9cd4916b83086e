//! Damage to files and to command lines.

use fastrand::Rng;

/// Texts that readers do not expect: numbers at and beyond every limit, characters that are not ASCII, not printable or
/// not UTF-8, beginnings and ends of what is quoted and nested.
const ODD: &[&[u8]] = &[
    b"0",
    b"-0",
    b"-1",
    b"1",
    b"255",
    b"256",
    b"65536",
    b"2147483648",
    b"4294967295",
    b"4294967296",
    b"9223372036854775808",
    b"99999999999999999999999999",
    b"1e308",
    b"-1e999",
    b"1e-320",
    b"1.#QNAN",
    b"NaN",
    b"inf",
    b"0x10",
    b"1/2/3",
    b"//",
    b"-5/-5/-5",
    b"\xef\xbb\xbf",
    b"\xff\xfe",
    b"\0",
    b"\x1b[2J",
    b"\x7f",
    b"\xc3\x28",
    "\u{202e}".as_bytes(),
    "Größe".as_bytes(),
    b"\r",
    b"\r\n",
    b"\n\n",
    b"\\\n",
    b"\t",
    b" ",
    b"#",
    b"\"",
    b"\\\"",
    b"[[[[[[[[[[[[[[[[",
    b"{\"a\":",
    b"]",
    b"}",
    b"null",
    b"true",
    b"..",
    b"../../../../etc/passwd",
    b"/dev/zero",
    b"/dev/stdin",
    b"-s 1 2 3",
    b"$(id)",
    b"`exit",
];

/// One to four changes of a text or of bytes; `other` is what parts are taken from.
pub fn mutate(seed: &[u8], other: &[u8], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..rng.usize(1..=4) {
        change(&mut bytes, other, rng);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, other: &[u8], rng: &mut Rng) {
    let [from, to] = range(bytes.len(), rng);
    match rng.u32(0..12) {
        0 => bytes.truncate(from),
        1 if !bytes.is_empty() => {
            let at = rng.usize(0..bytes.len());
            bytes[at] ^= 1 << rng.u32(0..8);
        }
        2 if !bytes.is_empty() => {
            let at = rng.usize(0..bytes.len());
            bytes[at] = rng.u8(..);
        }
        3 => drop(bytes.drain(from..to)),
        4 => {
            let part = bytes[from..to].to_vec();
            let times = rng.usize(1..=50);
            bytes.splice(to..to, part.repeat(times));
        }
        5 => {
            let [first, last] = range(other.len(), rng);
            bytes.splice(from..to, other[first..last].iter().copied());
        }
        6 => drop(bytes.splice(from..from, odd(rng).iter().copied())),
        _ => {
            // Most readers see words: one of them is replaced, dropped or said twice.
            let [first, last] = word(bytes, from);
            match rng.u32(0..4) {
                0 => drop(bytes.drain(first..last)),
                1 => {
                    let word = bytes[first..last].to_vec();
                    bytes.splice(last..last, [b" ", &word[..]].concat());
                }
                _ => drop(bytes.splice(first..last, odd(rng).iter().copied())),
            }
        }
    }
}

/// Changes one or two words of a command line.
pub(crate) fn mutate_line(line: &str, rng: &mut Rng) -> Vec<Vec<u8>> {
    let mut words: Vec<Vec<u8>> = line.split(' ').map(|word| word.as_bytes().to_vec()).collect();
    for _ in 0..rng.usize(1..=2) {
        // The command itself stays: others take long, or wait for tools.
        let at = rng.usize(1..=words.len());
        let last = at == words.len();
        match rng.u32(0..5) {
            0 if !last => drop(words.remove(at)),
            1 if !last => words.insert(at, words[at].clone()),
            2 if !last => words[at] = mutate(&words[at].clone(), line.as_bytes(), rng),
            3 if !last => words[at] = odd(rng).to_vec(),
            _ => words.insert(at, odd(rng).to_vec()),
        }
    }
    words.iter_mut().for_each(tame);
    words
}

/// Makes an argument of a word: it has no zero byte, and names nothing outside of the folder, where the program
/// might write, but for devices.
fn tame(word: &mut Vec<u8>) {
    word.retain(|byte| *byte != 0);
    if !word.starts_with(b"/dev/") || !ODD.contains(&&word[..]) {
        word.retain(|byte| *byte != b'/');
        while word.ends_with(b"..") {
            word.pop();
        }
    }
}

fn odd(rng: &mut Rng) -> &'static [u8] {
    ODD[rng.usize(0..ODD.len())]
}

/// A part of so many bytes: mostly a short one.
fn range(length: usize, rng: &mut Rng) -> [usize; 2] {
    let from = rng.usize(0..=length);
    let most = if rng.u32(0..4) == 0 { length - from } else { (length - from).min(16) };
    [from, from + rng.usize(0..=most)]
}

/// The word around a place.
fn word(bytes: &[u8], at: usize) -> [usize; 2] {
    let is_end = |byte: &u8| byte.is_ascii_whitespace() || b",:[]{}\"=".contains(byte);
    let from = bytes[..at].iter().rposition(is_end).map_or(0, |before| before + 1);
    let to = bytes[at..].iter().position(is_end).map_or(bytes.len(), |after| at + after);
    [from, to]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_does_the_same_damage() {
        let damage = |seed| mutate(b"v 1 2 3\nf 1 2 3\n", b"vt 0 1", &mut Rng::with_seed(seed));
        assert_eq!(damage(7), damage(7));
        assert!((0..50).map(damage).collect::<std::collections::BTreeSet<_>>().len() > 40);
        // Nothing is too short for it.
        (0..200).for_each(|seed| drop(mutate(b"", b"", &mut Rng::with_seed(seed))));
        let line = |seed| mutate_line("list", &mut Rng::with_seed(seed));
        assert!((0..200).all(|seed| line(seed)[0] == b"list"));
        for seed in 0..2000 {
            for word in mutate_line("rig --json out --out=out", &mut Rng::with_seed(seed)) {
                let leads_out = word.ends_with(b"..") || word.contains(&b'/');
                assert!(!leads_out || word.starts_with(b"/dev/"), "{word:?}");
            }
        }
    }
}
