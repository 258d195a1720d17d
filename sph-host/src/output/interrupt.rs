//! Ctrl-C leaves no half-written file: temporary files are registered, and a handler removes them.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// The registry; a thread that panicked while it held the lock has left it usable.
fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on Ctrl-C (and SIGTERM, SIGHUP) removes every unfinished file of this module and ends the process with status 130.
///
/// Call it once, early. A second call changes nothing.
///
/// # Errors
///
/// When the system refuses the handler.
pub fn cleanup_on_interrupt() -> Result<(), ctrlc::Error> {
    let handler = || {
        // Held until the process has ended, so that no file is begun or renamed meanwhile.
        let paths = unfinished();
        for path in paths.iter() {
            // The process ends: a failure cannot be reported any more.
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(130);
    };
    match ctrlc::set_handler(handler) {
        Err(ctrlc::Error::MultipleHandlers) => Ok(()),
        other => other,
    }
}

/// How the names of temporary files begin and end; between are letters and digits.
const PREFIX: &str = ".fluisim-";
const SUFFIX: &str = ".part";

/// Whether a path has the name of a temporary file of this module, as one that was killed leaves behind.
pub(crate) fn is_unfinished(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let between = name.strip_prefix(PREFIX).and_then(|name| name.strip_suffix(SUFFIX)).unwrap_or_default();
    !between.is_empty() && between.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

/// A temporary file in `directory` that is removed when dropped and on an interrupt.
pub(super) struct Unfinished(Option<NamedTempFile>);

impl Unfinished {
    /// Begins a file with the permissions of an ordinary one.
    pub(super) fn begin(directory: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX).suffix(SUFFIX);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut paths = unfinished();
        let file = builder.tempfile_in(directory)?;
        paths.insert(file.path().to_owned());
        Ok(Self(Some(file)))
    }

    /// The file to write to.
    pub(super) fn file(&mut self) -> io::Result<&mut std::fs::File> {
        let file = self.0.as_mut().ok_or(io::ErrorKind::NotFound)?;
        Ok(file.as_file_mut())
    }

    /// Waits until the file's bytes are on the disk; where a file system cannot tell, nothing is waited for.
    pub(super) fn sync(&mut self) -> io::Result<()> {
        refused_is_fine(self.file()?.sync_data())
    }

    /// Gives the file its name, and waits until the folder has it; an existing one is replaced only when `force` says so.
    pub(super) fn finish(mut self, path: &Path, force: bool) -> io::Result<()> {
        let mut paths = unfinished();
        let Some(file) = self.0.take() else { return Ok(()) };
        paths.remove(file.path());
        let kept = if force { file.persist(path) } else { file.persist_noclobber(path) };
        kept.map(drop).map_err(|error| error.error)?;
        drop(paths);
        sync_folder(path)
    }
}

/// Waits until the folder of `path` is on the disk, where the system can.
fn sync_folder(path: &Path) -> io::Result<()> {
    #[cfg(unix)]
    {
        let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
        // A folder that may be written but not read cannot be opened: then the system decides when.
        if let Ok(folder) = std::fs::File::open(folder) {
            return refused_is_fine(folder.sync_all());
        }
    }
    let _ = path;
    Ok(())
}

/// Some file systems and folders do not know fsync: EINVAL or ENOTSUP.
fn refused_is_fine(synced: io::Result<()>) -> io::Result<()> {
    match synced {
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => {
            Ok(())
        }
        other => other,
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            let mut paths = unfinished();
            paths.remove(file.path());
            drop(file);
        }
    }
}
