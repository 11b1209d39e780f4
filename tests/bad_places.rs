//! Places where writing goes wrong: disks that are full or read-only, a process that is killed, a pipe that is
//! closed. Each runs `foliar` in a folder that already holds an old `out.glb`.

use crate::bad_input::OLD;
use crate::common::{FOLIAR, Run, command, finish, run_in, skip, text};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Bytes (in blocks of 512) that the shell lets a process write to a file: less than any output.
const BLOCKS: &str = "ulimit -f 8; ";

/// A tmpfs, gone when dropped.
struct Disk(PathBuf);

impl Disk {
    /// Mounts one over a new folder, with the old output in it; none where that is forbidden.
    fn mount() -> Option<Disk> {
        let path = std::env::temp_dir().join(format!("foliar-disk-{}", std::process::id()));
        let path = (0..).map(|n| path.with_extension(n.to_string())).find(|p| std::fs::create_dir(p).is_ok())?;
        let disk = Disk(path);
        if !disk.mounted("size=8k") {
            skip("a small tmpfs cannot be mounted here");
            return None;
        }
        std::fs::write(disk.out(), OLD).unwrap();
        Some(disk)
    }

    fn mounted(&self, options: &str) -> bool {
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", options, "tmpfs", text(&self.0)]);
        mount.stderr(Stdio::null()).status().is_ok_and(|status| status.success())
    }

    fn out(&self) -> PathBuf {
        self.0.join("out.glb")
    }

    /// Bakes onto it; the old output must stay, and nothing else be there.
    fn bake(&self, here: &Path, input: &str) -> Run {
        let run = run_in(here, FOLIAR, &["bake", input, "-o", text(&self.out())]);
        assert_eq!(std::fs::read(self.out()).unwrap(), OLD, "{run:?}");
        assert_eq!(std::fs::read_dir(&self.0).unwrap().count(), 1, "{run:?}");
        run
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        _ = Command::new("umount").arg(&self.0).stderr(Stdio::null()).status();
        _ = std::fs::remove_dir(&self.0);
    }
}

/// A disk of two pages, one of which the old output takes.
pub fn at_full_disk(here: &Path, arguments: &[&str]) -> Option<Run> {
    Some(Disk::mount()?.bake(here, arguments[1]))
}

/// A disk that was mounted again, read-only.
pub fn at_read_only_disk(here: &Path, arguments: &[&str]) -> Option<Run> {
    let disk = Disk::mount()?;
    assert!(disk.mounted("remount,ro"), "what was mounted can be mounted again");
    Some(disk.bake(here, arguments[1]))
}

/// A folder without write permission, which stops everybody but root.
#[cfg(unix)]
pub fn at_read_only_folder(here: &Path, arguments: &[&str]) -> Option<Run> {
    use std::os::unix::fs::PermissionsExt;
    let mode = |mode| std::fs::set_permissions(here, std::fs::Permissions::from_mode(mode)).unwrap();
    mode(0o555);
    let stops = std::fs::File::create(here.join("probe")).is_err();
    let run = stops.then(|| run_in(here, FOLIAR, arguments));
    mode(0o755);
    if !stops {
        skip("a read-only folder stops nobody who runs as root");
        std::fs::remove_file(here.join("probe")).unwrap();
    }
    run
}

/// A limit on the size of files, which the system reports as an error: as a full disk does, and for everybody.
pub fn at_full_file(here: &Path, arguments: &[&str]) -> Option<Run> {
    Some(limited(here, "trap '' XFSZ; ", arguments))
}

/// The same limit, at which the system kills the process: in the middle of writing.
pub fn killed(here: &Path, arguments: &[&str]) -> Option<Run> {
    let run = limited(here, "", arguments);
    let parts = |here: &Path| -> Vec<PathBuf> {
        let files = std::fs::read_dir(here).unwrap().map(|file| file.unwrap().path());
        files.filter(|file| file.extension().is_some_and(|ending| ending == "part")).collect()
    };
    let left = parts(here);
    assert_eq!(left.len(), 1, "the half-written file of the dead: {run:?}");
    assert!(std::fs::metadata(&left[0]).unwrap().len() > 0, "it was killed while writing, not before");
    // The next bake takes it away; here the old output is wanted back.
    run_in(here, FOLIAR, arguments).expect(0, &[]);
    assert!(parts(here).is_empty(), "the next bake takes it away");
    std::fs::write(here.join("out.glb"), OLD).unwrap();
    Some(run)
}

fn limited(here: &Path, trap: &str, arguments: &[&str]) -> Run {
    let mut shell = command("sh");
    shell.args(["-c", &format!("{trap}{BLOCKS}exec \"$@\""), "sh", FOLIAR]).args(arguments);
    finish(shell.current_dir(here).stdin(Stdio::null()).output().unwrap())
}

/// A reader of standard output that is gone.
pub fn through_closed_pipe(here: &Path, arguments: &[&str]) -> Option<Run> {
    let mut baking = command(FOLIAR);
    baking.args(["bake", arguments[1], "-o", "-", "--quiet"]).current_dir(here);
    let mut child = baking.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let run = finish(child.wait_with_output().unwrap());
    assert_eq!(run.stderr, "", "a closed pipe ends quietly");
    Some(run)
}
