//! The committed records that commands write and compare with.

use super::failure::{Failure, MISMATCH, OK};
use super::folders::root;
use crate::verification::{self, Record};
use std::path::Path;

/// The record of a workspace in that file; the first one has nothing before it.
pub(super) fn recorded<R: Default, E: Into<Failure>>(
    root: &Path,
    file: &str,
    read: impl FnOnce(&Path) -> Result<R, E>,
) -> Result<R, Failure> {
    match root.join(file).exists() {
        true => read(root).map_err(Into::into),
        false => Ok(R::default()),
    }
}

/// Tells what is wrong, or not as in the record of that file, and gives the exit status.
pub(super) fn checked(faults: &[String], file: &str) -> u8 {
    if faults.is_empty() {
        say!("as recorded in {file}");
        return OK;
    }
    faults.iter().for_each(|fault| say!("{fault}"));
    say!("where only {file} is out of date, renew it with --record in place of --check");
    MISMATCH
}

/// The record of coverage and replay.
pub(super) fn verification_record() -> Result<Record, Failure> {
    Ok(Record::read(&root()?)?)
}

/// Changes the record of coverage and replay.
pub(super) fn update_record(change: impl FnOnce(&mut Record)) -> Result<(), Failure> {
    let root = root()?;
    let mut record = recorded(&root, verification::FILE, Record::read)?;
    change(&mut record);
    record.write(&root)?;
    say!("{}: written; now run: wheatstone generate", verification::FILE);
    Ok(())
}
