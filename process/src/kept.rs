//! The kept output of a program: its beginning and its end.

use crate::event::Event;
use std::collections::VecDeque;
use std::io::Read;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

/// The kept part of a stream.
#[derive(Default)]
struct Part {
    head: Vec<u8>,
    tail: VecDeque<u8>,
    left_out: u64,
    is_drained: bool,
}

/// A stream that is being read.
pub(crate) struct Kept(Arc<Mutex<Part>>);

impl Kept {
    /// Reads a stream to its end and keeps `kept` bytes of it. Tells when it has ended, and when it has gone on for
    /// `flood` bytes more.
    pub fn drain(
        stream: Option<impl Read + Send + 'static>,
        kept: usize,
        flood: u64,
        events: &Sender<Event>,
    ) -> Kept {
        let part = Arc::new(Mutex::new(Part::default()));
        let (own, events) = (part.clone(), events.clone());
        let run = move || {
            let mut stream = stream;
            let mut buffer = vec![0; 1 << 16];
            while let Some(stream) = &mut stream {
                let bytes = match stream.read(&mut buffer) {
                    Ok(0) => break,
                    Ok(bytes) => bytes,
                    Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
                    Err(_) => break,
                };
                let mut part = lock(&own);
                let before = part.left_out;
                part.add(&buffer[..bytes], kept);
                if before < flood && part.left_out >= flood {
                    let _ = events.send(Event::Flood);
                }
            }
            lock(&own).is_drained = true;
            let _ = events.send(Event::Drained);
        };
        thread::spawn(run);
        Kept(part)
    }

    /// True if the stream has ended.
    pub fn is_drained(&self) -> bool {
        lock(&self.0).is_drained
    }

    /// Takes the bytes that were kept so far, with a line in the place of those that were not.
    pub fn take(&self) -> Vec<u8> {
        let part = std::mem::take(&mut *lock(&self.0));
        let mut bytes = part.head;
        if part.left_out > 0 {
            bytes.extend(format!("\n[{} bytes left out]\n", part.left_out).into_bytes());
        }
        bytes.extend(part.tail);
        bytes
    }
}

fn lock(part: &Mutex<Part>) -> MutexGuard<'_, Part> {
    part.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Part {
    /// Half of what is kept is the beginning.
    fn add(&mut self, bytes: &[u8], kept: usize) {
        let room = (kept / 2 + kept % 2).saturating_sub(self.head.len()).min(bytes.len());
        self.head.extend_from_slice(&bytes[..room]);
        self.tail.extend(&bytes[room..]);
        let over = self.tail.len().saturating_sub(kept / 2);
        self.tail.drain(..over);
        self.left_out += over as u64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_beginning_and_the_end_are_kept() {
        for (kept, expected) in
            [(20, "0123456789"), (10, "0123456789"), (4, "01\n[6 bytes left out]\n89")]
        {
            for step in [1, 3, 10] {
                let mut part = Part::default();
                b"0123456789".chunks(step).for_each(|bytes| part.add(bytes, kept));
                let text = String::from_utf8(Kept(Arc::new(Mutex::new(part))).take()).unwrap();
                assert_eq!(text, expected, "{kept} kept, {step} at once");
            }
        }
    }
}
