//! Standard input and output, closed pipes, places that cannot be written (disks: bad_places.rs).

use crate::common::{FOLIAR, command, finish, folder, output, run, run_in, skip, text, tree, tree_text};
use std::fs::File;
use std::io::Write;
use std::process::Stdio;

#[test]
fn dashes_mean_standard_input_and_output() {
    let (here, out) = (folder(), output("streams.glb"));
    let input = tree(here.path(), 40);
    run(FOLIAR, &["bake", text(&input), "-o", text(&out), "--up", "y", "--unit", "m"]).expect(0, &[]);
    let mut child = command(FOLIAR)
        .args(["bake", "-", "-o", "-", "--up", "y", "--unit", "m"])
        .current_dir(here.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(tree_text(40).as_bytes()).unwrap();
    let piped = child.wait_with_output().unwrap();
    assert!(piped.status.success(), "{}", String::from_utf8_lossy(&piped.stderr));
    assert!(piped.stdout == std::fs::read(&out).unwrap(), "a pipe gives the file's bytes and nothing else");
}

#[test]
fn a_closed_pipe_ends_quietly() {
    let (here, out) = (folder(), output("streams-closed.glb"));
    let input = tree(here.path(), 40);
    run(FOLIAR, &["bake", text(&input), "-o", text(&out)]).expect(0, &[]);
    for arguments in [vec!["inspect", text(&out)], vec!["config"], vec!["--help"], vec!["bake", text(&out), "-o", "-"]]
    {
        let mut child = command(FOLIAR).args(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let run = finish(child.wait_with_output().unwrap());
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{arguments:?}");
    }
}

#[test]
fn quiet_says_nothing_but_errors() {
    let (here, out) = (folder(), output("streams-quiet.glb"));
    let input = tree(here.path(), 40);
    let quiet = run(FOLIAR, &["bake", text(&input), "-o", text(&out), "--quiet"]).expect(0, &[]);
    assert_eq!((quiet.stdout.as_str(), quiet.stderr.as_str()), ("", ""));
    let json = run(FOLIAR, &["bake", text(&input), "-o", text(&out), "--quiet", "--format", "json"]).expect(0, &[]);
    assert_eq!(json.json_lines().len(), 1, "what was asked for in JSON is no chatter");
    run(FOLIAR, &["bake", "no.obj", "-o", text(&out), "--quiet"]).expect(3, &["error: no.obj: cannot be read"]);
}

#[test]
fn an_output_that_cannot_be_written_is_status_4() {
    let here = folder();
    tree(here.path(), 40);
    std::fs::create_dir(here.path().join("taken.glb")).unwrap();
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "taken.glb"])
        .expect(4, &["taken.glb", "cannot be written"]);
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "no/such/folder.glb"]).expect(4, &["no/such/folder.glb"]);
    std::fs::write(here.path().join("file"), "").unwrap();
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-d", "file"]).expect(4, &["file", "cannot be written"]);
    let left: Vec<_> = std::fs::read_dir(here.path()).unwrap().map(|f| f.unwrap().file_name()).collect();
    assert_eq!(left.len(), 4, "no temporary file is left: {left:?}");
}

#[test]
fn a_full_device_is_status_4() {
    let Ok(full) = File::options().write(true).open("/dev/full") else {
        skip("no /dev/full here");
        return;
    };
    let here = folder();
    let arguments = ["bake", text(&tree(here.path(), 40)), "-o", "-"].map(str::to_owned);
    let run = finish(command(FOLIAR).args(arguments).stdout(full).stderr(Stdio::piped()).output().unwrap());
    run.expect(4, &["standard output cannot be written"]);
}
