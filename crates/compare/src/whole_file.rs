//! Files that appear whole or not at all: written beside their place, then renamed into it.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::TempPath;

/// Writes the file `path` with what `write` puts out, replacing an older one in one step.
///
/// The bytes go to a temporary file in the same folder, which is renamed when `write` has succeeded: a reader,
/// or a later run after a crash, never sees half a file. The permissions of the older file are kept. A symbolic link
/// keeps pointing where it did, even if nothing is there yet. Something that is not a regular file (a pipe,
/// `/dev/null`) cannot be replaced and is written to directly.
///
/// # Errors
///
/// Whatever `write` or the file system reports; `path` is then as it was before.
pub fn write<E: From<io::Error>>(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<(), E>) -> Result<(), E> {
    match destination(path)? {
        Destination::Special => into(File::options().write(true).open(path)?, write).map(drop),
        Destination::Regular(path) => replace(&path, write),
    }
}

/// Removes the temporary files of all writes under way, for a process that is about to end.
///
/// From then on no write begins or finishes: whoever tries waits for the end of the process. Call it from a thread
/// that waits for signals, and end the process afterwards.
pub fn abandon() {
    let unfinished = unfinished();
    for path in unfinished.iter() {
        // The process ends whether or not the file can be removed.
        let _removed_or_not = fs::remove_file(path);
    }
    // Never unlocked: nothing may appear after the clean-up.
    std::mem::forget(unfinished);
}

/// Temporary files of writes under way. Held while one is made or renamed, so that [`abandon`] misses none.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    // A set of paths is whole after every statement, so a panic elsewhere does not spoil it.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file that [`abandon`] knows of until it is dropped or persisted.
struct Unfinished {
    path: Option<TempPath>,
}

impl Unfinished {
    fn new(folder: &Path) -> io::Result<(File, Self)> {
        let mut unfinished = unfinished();
        // The name of the temporary file, which the original error holds, means nothing to anyone.
        let made = builder().tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
        let (file, path) = made.into_parts();
        unfinished.insert(path.to_path_buf());
        Ok((file, Self { path: Some(path) }))
    }

    /// Renames the file to `path`.
    fn persist(mut self, path: &Path) -> io::Result<()> {
        let mut unfinished = unfinished();
        let Some(temporary) = self.path.take() else { return Ok(()) };
        unfinished.remove::<Path>(&temporary);
        temporary.persist(path).map_err(|failed| failed.error)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some(path) = self.path.take() {
            let mut unfinished = unfinished();
            unfinished.remove::<Path>(&path);
            // Removes the file, while nobody can be in between.
            drop(path);
        }
    }
}

enum Destination {
    /// A regular file or a free name, with links resolved.
    Regular(PathBuf),
    /// Something that is written to but never replaced.
    Special,
}

fn destination(path: &Path) -> io::Result<Destination> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(io::Error::from(io::ErrorKind::IsADirectory)),
        Ok(found) if found.is_file() => path.canonicalize().map(Destination::Regular),
        Ok(_) => Ok(Destination::Special),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Destination::Regular(end_of_links(path))),
        Err(error) => Err(error),
    }
}

/// The free name that a chain of symbolic links ends at; `path` itself if it is no link.
fn end_of_links(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    // The chain has an end: a ring of links would not have been found missing.
    while let Ok(target) = fs::read_link(&path) {
        path = folder_of(&path).join(target);
    }
    path
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn replace<E: From<io::Error>>(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<(), E>) -> Result<(), E> {
    let (file, temporary) = Unfinished::new(folder_of(path))?;
    into(file.try_clone()?, write)?;
    if let Ok(older) = fs::metadata(path) {
        file.set_permissions(older.permissions())?;
    }
    // Windows renames no file that is open.
    drop(file);
    Ok(temporary.persist(path)?)
}

/// A builder of temporary files that get the permissions of an ordinary new file (temporary files are private
/// unless told otherwise; the process's umask still applies).
fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".osculate-");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

fn into<E: From<io::Error>>(file: File, write: impl FnOnce(&mut dyn Write) -> Result<(), E>) -> Result<(), E> {
    let mut buffered = BufWriter::with_capacity(1 << 16, file);
    write(&mut buffered)?;
    Ok(buffered.flush()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn put(path: &Path, bytes: &[u8]) -> io::Result<()> {
        write(path, |out| out.write_all(bytes))
    }

    #[test]
    fn replaces_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        put(&path, b"old").unwrap();
        put(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[test]
    fn a_failed_write_leaves_the_folder_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        put(&path, b"old").unwrap();
        let result: io::Result<()> = write(&path, |out| {
            out.write_all(&[0; 100_000])?;
            Err(io::Error::other("halfway"))
        });
        assert!(result.is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(put(folder.path(), b"x").unwrap_err().kind(), io::ErrorKind::IsADirectory);
        assert!(put(&folder.path().join("missing/a"), b"x").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn links_and_devices_survive() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        put(&file, b"old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        put(&link, b"new").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        put(Path::new("/dev/null"), b"gone").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    #[cfg(unix)]
    #[test]
    fn others_may_read_the_file_as_far_as_the_umask_lets_them() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        put(&ours, b"x").unwrap();
        fs::write(&plain, b"x").unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_nothing_yet_is_followed() {
        let folder = tempfile::tempdir().unwrap();
        let (first, second) = (folder.path().join("first"), folder.path().join("second"));
        std::os::unix::fs::symlink("second", &first).unwrap();
        std::os::unix::fs::symlink("file", &second).unwrap();
        put(&first, b"new").unwrap();
        assert_eq!(fs::read(folder.path().join("file")).unwrap(), b"new");
        assert!(
            fs::symlink_metadata(&first).unwrap().is_symlink() && fs::symlink_metadata(&second).unwrap().is_symlink()
        );
        std::os::unix::fs::symlink("ring", folder.path().join("ring")).unwrap();
        assert!(put(&folder.path().join("ring"), b"x").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_replaced_file_keeps_its_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        put(&path, b"old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        put(&path, b"new").unwrap();
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[test]
    fn errors_do_not_show_the_temporary_name() {
        let folder = tempfile::tempdir().unwrap();
        let error = put(&folder.path().join("missing/a"), b"x").unwrap_err();
        assert!(!error.to_string().contains(".osculate-"), "{error}");
    }

    #[test]
    fn writes_under_way_are_known_until_they_end() {
        let folder = tempfile::tempdir().unwrap();
        let ours = || unfinished().iter().filter(|path| path.starts_with(folder.path())).count();
        write(&folder.path().join("a"), |_| {
            assert_eq!(ours(), 1);
            Ok::<(), io::Error>(())
        })
        .unwrap();
        assert_eq!(ours(), 0);
        let failed = write(&folder.path().join("b"), |_| Err(io::Error::other("halfway")));
        assert!(failed.is_err());
        assert_eq!(ours(), 0);
    }
}
