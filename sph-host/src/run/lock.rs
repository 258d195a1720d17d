//! One run at a time in a directory.

use std::fs::{File, TryLockError};
use std::io::{ErrorKind, Write};

use super::error::Error;
use super::folder::{RunFolder, failed};

/// A file that a run holds as long as it writes; it stays behind, with the number of the last process that held it.
const NAME: &str = ".lock";

/// The right to write in a directory, until it is dropped or the process ends, however it ends.
#[derive(Debug)]
pub(super) struct Lock {
    /// `None` where the file system knows no locks.
    _file: Option<File>,
}

impl Lock {
    /// Whether the directory has the file, held or not.
    pub(super) fn is_in(folder: &RunFolder) -> bool {
        folder.path().join(NAME).exists()
    }

    /// Takes the directory, which is there.
    ///
    /// # Errors
    /// [`Error::InUse`] while another process writes there; what the system said where the file cannot be made.
    pub(super) fn take(folder: &RunFolder) -> Result<Self, Error> {
        let path = folder.path().join(NAME);
        let mut options = File::options();
        let mut file =
            options.read(true).write(true).create(true).truncate(false).open(&path).map_err(failed(&path))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let holder = std::fs::read_to_string(&path).ok();
                let holder = holder.and_then(|text| text.trim().parse().ok());
                return Err(Error::InUse { directory: folder.path().to_owned(), holder });
            }
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {
                return Ok(Self { _file: None });
            }
            Err(TryLockError::Error(error)) => return Err(failed(&path)(error)),
        }
        // who holds it is told to others, and no more depends on it
        let _ = file.set_len(0).and_then(|()| writeln!(file, "{}", std::process::id()));
        Ok(Self { _file: Some(file) })
    }
}
