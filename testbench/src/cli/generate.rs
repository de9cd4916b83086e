//! `wheatstone generate`.

use super::failure::{Failure, MISMATCH, OK};
use crate::generated::Generated;
use crate::workspace;
use clap::Args;
use wheatstone_golden::files;
use wheatstone_golden::text::printable_path;

#[derive(Debug, Args)]
pub(super) struct GenerateArgs {
    /// Write nothing; say what is not current, with exit status 1
    #[arg(long)]
    check: bool,
}

pub(super) fn run(args: &GenerateArgs) -> Result<u8, Failure> {
    let root = workspace::find().ok_or_else(|| {
        Failure::Input("no folder with rtl/sam_formats.vh here or above: not in a workspace".into())
    })?;
    let mut status = OK;
    for generated in Generated::all() {
        let path = generated.path();
        let file = root.join(&path);
        let present = files::read_own(&file)
            .map_err(|error| Failure::Input(format!("{}: {error}", printable_path(&file))))?;
        let renewed = generated.renewed(&present, &root)?;
        if renewed == present {
            continue;
        }
        if args.check {
            say!("{path}: not current; run: wheatstone generate");
            status = MISMATCH;
        } else {
            files::write(&file, renewed.as_bytes())?;
            say!("{path}: written");
        }
    }
    Ok(status)
}
