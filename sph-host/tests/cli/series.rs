//! Several files of particles, or a `.pvd`, have a result each.

use crate::support::Folder;

fn two_moments() -> Folder {
    let folder = Folder::with("a.csv", "x,y,m,A\n0,0,1,1\n1,1,1,2\n");
    folder.write("b.csv", "x,y,m,A\n0,0,1,3\n1,1,1,4\n");
    folder
}

#[test]
fn each_file_has_a_result_and_paraview_a_list_of_them() {
    let folder = two_moments();
    let words = "--support 1 --grid 2,2";
    let said = folder.succeed(&format!("sample a.csv b.csv {words} --out o_%04d.vti --timing"));
    assert_eq!(said.stderr.lines().filter(|line| line.starts_with("timing:")).count(), 2);
    let names: Vec<String> = folder.names().into_iter().collect();
    assert_eq!(names, ["a.csv", "b.csv", "o.pvd", "o_0000.vti", "o_0001.vti"]);
    for (file, result) in [("a.csv", "o_0000.vti"), ("b.csv", "o_0001.vti")] {
        folder.succeed(&format!("sample {file} {words} --out one.vti --force"));
        assert_eq!(folder.bytes(result), folder.bytes("one.vti"));
    }
    let list = String::from_utf8(folder.bytes("o.pvd")).unwrap();
    assert!(list.contains(r#"timestep="1" file="o_0001.vti""#), "{list}");
    folder.succeed(&format!("sample a.csv b.csv {words} --out t%d.csv"));
    assert!(!folder.names().contains("t.pvd") && folder.names().contains("t1.csv"));
}

#[test]
fn a_series_names_files_and_times() {
    let folder = two_moments();
    folder.write(
        "run.pvd",
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>\
         <DataSet timestep=\"0.25\" file=\"a.csv\"/><DataSet timestep=\"0.5\" part=\"0\" file=\"./b.csv\"/></Collection></VTKFile>",
    );
    folder.succeed("sample run.pvd --support 1 --grid 2,2 --out o_%d.vtu --part 1/2");
    let list = String::from_utf8(folder.bytes("o.pvd")).unwrap();
    assert!(list.contains(r#"timestep="0.25" file="o_0.pvtu""#), "{list}");
    assert!(list.contains(r#"timestep="0.5" file="o_1.pvtu""#), "{list}");
    // what a run leaves is such a series
    folder.succeed("run dam-break --resolution 8 --time 0.2 --every 0.1 --out run --quiet");
    folder.succeed("sample run/frames.pvd --support 0.3 --grid 4,4 --dim 2 --estimate shepard --quantity velocity --out f_%02d.vti");
    assert!(folder.names().contains("f_02.vti") && folder.names().contains("f.pvd"));
}

#[test]
fn series_that_cannot_be_are_refused() {
    let folder = two_moments();
    let words = "--support 1 --grid 2,2";
    folder.fail_with(2, &format!("sample a.csv b.csv {words}"), &["--out", "%04d"]);
    folder.fail_with(2, &format!("sample a.csv b.csv {words} --out o.vti"), &["--out", "%04d"]);
    folder.fail_with(2, "sample", &["<PARTICLES>"]);
    folder.fail_with(2, &format!("sample - - {words} --format csv --out o_%d.csv"), &["standard input"]);
    folder.fail_with(
        2,
        &format!("sample a.csv b.csv {words} --group fluid --out o_%d.csv"),
        &["a.csv", "--group"],
    );
    for (content, parts) in [
        ("", &["s.pvd", "empty"][..]),
        ("<VTKFile/>", &["s.pvd", "Collection"]),
        ("<Collection></Collection>", &["names no file"]),
        ("<Collection><DataSet/></Collection>", &["byte 12", "names no file"]),
        ("<Collection><DataSet file=\"../a.csv\"/></Collection>", &["`../a.csv`", "folder"]),
        ("<Collection><DataSet file=\"/etc/x.csv\"/></Collection>", &["`/etc/x.csv`"]),
        ("<Collection><DataSet file=\"a.csv\" timestep=\"x\"/></Collection>", &["`x`", "number"]),
        ("<Collection><DataSet", &["s.pvd", "byte 12"]),
        (
            "<Collection><DataSet timestep=\"1\" file=\"a.csv\"/><DataSet timestep=\"1\" file=\"b.csv\"/></Collection>",
            &["`b.csv`", "time 1", ".pvtu"],
        ),
    ] {
        folder.write("s.pvd", content);
        let message = folder.fail(1, &format!("sample s.pvd {words} --out o_%d.vti"));
        assert!(parts.iter().all(|part| message.contains(part)), "{content}: {message}");
    }
    folder.write("b.csv", "x,y,m,A\n0,0,1,3\n1,1,-1,4\n");
    let said = folder.run(&format!("sample a.csv b.csv {words} --out o_%d.vti"));
    assert_eq!(said.status, Some(1));
    assert!(said.stderr.contains("b.csv: line 3"), "{}", said.stderr);
    assert!(folder.names().contains("o_0.vti"), "what is done stays");
    folder.fail_with(1, &format!("sample a.csv b.csv {words} --out o_%d.vti"), &["o_0.vti", "--force"]);
}
