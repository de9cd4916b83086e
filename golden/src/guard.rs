//! Work of libraries on untrusted input, whose panics become errors.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// True while this thread does guarded work.
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Does work that leaves nothing behind but its result. A panic in it is not printed, and becomes an error.
pub fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !GUARDED.get() {
                usual(info);
            }
        }));
    });
    let outer = GUARDED.replace(true);
    let done = panic::catch_unwind(AssertUnwindSafe(work));
    GUARDED.set(outer);
    done.map_err(|cause| format!("the decoder failed: {}", message(cause.as_ref())))
}

fn message(cause: &(dyn Any + Send)) -> &str {
    let literal = cause.downcast_ref::<&str>().copied();
    literal.or_else(|| cause.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_with_its_message() {
        assert_eq!(guarded(|| 7), Ok(7));
        let empty: Vec<u8> = Vec::new();
        let error = guarded(|| empty[empty.len() + 2]).expect_err("beyond the end");
        assert!(error.starts_with("the decoder failed: index out of bounds"), "{error}");
        let nested = guarded(|| guarded(|| panic!("inside")).map(|()| 1));
        assert_eq!(nested, Ok(Err("the decoder failed: inside".into())));
        assert!(!GUARDED.get());
    }
}
