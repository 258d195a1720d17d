//! `--part`: several processes evaluate a share of the points each.

use crate::support::{Columns, Folder, is_close, magnitude};

/// The rows of all parts on end.
fn joined(folder: &Folder, words: &str, parts: usize) -> Columns {
    let mut all: Option<Columns> = None;
    for part in 1..=parts {
        let found = folder.columns(&format!("{words} --part {part}/{parts}"));
        all = Some(match all {
            None => found,
            Some(mut all) => {
                assert_eq!(all.names, found.names);
                all.values.iter_mut().zip(found.values).for_each(|(all, found)| all.extend(found));
                all
            }
        });
    }
    all.unwrap()
}

#[test]
fn parts_give_what_the_whole_gives() {
    let folder = Folder::new();
    folder.succeed("sample demo:drop --particles 800 --at-particles --out p.csv");
    let text = String::from_utf8(folder.bytes("p.csv")).unwrap();
    let wanted: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    assert!(wanted.contains(&"density"), "{wanted:?}");
    let words = "sample p.csv --mass 1e-3 --support 0.3";
    folder.write(
        "at.csv",
        text.lines()
            .map(|line| line.splitn(4, ',').take(3).collect::<Vec<_>>().join(",") + "\n")
            .collect::<String>(),
    );
    for (place, options) in [
        ("--grid 5,4,9", "--gradient"),
        ("--grid 5,4,9 --bounds -3,-3,-3,3,3,3", "--recompute-density"),
        ("--grid 3,3,7", "--recompute-density --periodic -1,-1,-1,1,1,1"),
        ("--at-particles", "--estimate shepard"),
        ("--at at.csv", "--recompute-density --gradient"),
    ] {
        for parts in [1, 2, 5] {
            let exact = format!("{words} {place} {options} --exact");
            assert_eq!(joined(&folder, &exact, parts), folder.columns(&exact), "{exact} in {parts}");
            let fast = format!("{words} {place} {options}");
            let (whole, joined_up) = (folder.columns(&fast), joined(&folder, &fast, parts));
            for (whole, part) in whole.values.iter().zip(&joined_up.values) {
                let scale = magnitude(whole);
                assert!(
                    whole.iter().zip(part).all(|(&a, &b)| is_close(a, b, 1e-12, scale)),
                    "{fast} in {parts}"
                );
            }
            if place != "--at-particles" {
                let chunked = format!("{exact} --chunk 300");
                assert_eq!(joined(&folder, &chunked, parts), folder.columns(&exact), "{chunked} in {parts}");
            }
        }
    }
}

#[test]
fn the_first_part_leaves_the_file_that_joins_them() {
    let folder = Folder::new();
    let words = "sample demo:drop --particles 500 --grid 4,4,6 --gradient --exact";
    folder.succeed(&format!("{words} --out whole.vti"));
    for part in 1..=3 {
        folder.succeed(&format!("{words} --out field.vti --part {part}/3"));
    }
    let names: Vec<String> = folder.names().into_iter().collect();
    assert_eq!(names, ["field.pvti", "field_1.vti", "field_2.vti", "field_3.vti", "whole.vti"]);
    let text = |name: &str| String::from_utf8(folder.bytes(name)).unwrap();
    let header = |name: &str, element: &str| {
        let text = text(name);
        text.lines().find(|line| line.starts_with(element)).unwrap().to_owned()
    };
    let (joint, whole) = (text("field.pvti"), header("whole.vti", "<ImageData "));
    let origin = &whole[whole.find("Origin").unwrap()..];
    assert!(joint.contains(r#"WholeExtent="0 3 0 3 0 5""#) && joint.contains(origin), "{joint}");
    // neighbours share a layer of points: no cell is missing between
    for (part, extent) in [(1, "0 3 0 3 0 2"), (2, "0 3 0 3 2 4"), (3, "0 3 0 3 4 5")] {
        let piece = format!(r#"<Piece Extent="{extent}" Source="field_{part}.vti"/>"#);
        assert!(joint.contains(&piece), "{piece} is missing in {joint}");
        let own = header(&format!("field_{part}.vti"), "<ImageData ");
        assert!(own.contains(extent) && own.contains(origin), "{own}");
    }
    for part in 1..=2 {
        folder
            .succeed(&format!("sample demo:drop --particles 500 --at-particles --out p.vtu --part {part}/2"));
    }
    let joint = text("p.pvtu");
    for part in ["p_1.vtu", "p_2.vtu", "PUnstructuredGrid", r#"Name="density""#] {
        assert!(joint.contains(part), "{part} is missing in {joint}");
    }
}

#[test]
fn launchers_say_which_part_it_is() {
    let folder = Folder::new();
    let words = "sample demo:vortex --particles 100 --grid 4,4";
    let expected = folder.succeed(&format!("{words} --part 3/4")).stdout;
    for (rank, size, value) in [
        ("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "2"),
        ("PMI_RANK", "PMI_SIZE", "2"),
        ("SLURM_PROCID", "SLURM_NTASKS", "2"),
        ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "3"),
    ] {
        let mut command = folder.command(&format!("{words} --part auto"));
        let output = command.env(rank, value).env(size, "4").output().unwrap();
        assert_eq!(String::from_utf8(output.stdout).unwrap(), expected, "{rank}");
    }
}

#[test]
fn parts_that_cannot_be_are_refused() {
    let folder = Folder::with("p.csv", "x,y,m\n0,0,1\n1,1,1\n");
    let words = "sample p.csv --support 1 --quantity m";
    for wrong in ["0/2", "3/2", "a", "auto"] {
        folder.fail_with(2, &format!("{words} --grid 4,4 --part {wrong}"), &["--part"]);
    }
    folder.fail_with(1, &format!("{words} --grid 4,2 --part 1/3"), &["p.csv", "2 layers", "3 parts"]);
    folder.fail_with(2, &format!("{words} --grid 4,4 --part 1/2 --out a.png"), &["--part", "picture"]);
    assert_eq!(folder.columns(&format!("{words} --at-particles --part 3/3")).get("x").len(), 1);
    assert_eq!(
        folder.columns(&format!("{words} --at-particles --part 1/3")).get("x").len(),
        0,
        "more parts than points"
    );
    folder.write("a.pvti", "old");
    folder.fail_with(1, &format!("{words} --grid 4,4 --part 1/2 --out a.vti"), &["a.pvti", "--force"]);
    folder.succeed(&format!("{words} --grid 4,4 --part 2/2 --out a.vti"));
    assert_eq!(folder.bytes("a.pvti"), b"old", "the second part leaves it alone");
}
