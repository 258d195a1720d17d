//! Small files that claim much: refused, or faults of their arrays, in a moment and without the memory that they ask for.

use std::sync::mpsc;
use std::time::Duration;

use zip::CompressionMethod;

use crate::support::{archive, npy, read, refused, unusable};

/// A watchdog, no measure of speed: each takes seconds on any machine, and hours where the time grows as the square of the file.
const HANG: Duration = Duration::from_secs(300);

fn without_hanging<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || sender.send(work()));
    receiver.recv_timeout(HANG).expect("a result before the watchdog")
}

#[test]
fn an_array_of_a_million_million_numbers_for_no_point_is_not_named_number_by_number() {
    let members = [("x.npy", npy("(0,)", &[])), ("a.npy", npy("(0, 1000000000000)", &[]))];
    let table = read("p.npz", archive(&members, CompressionMethod::Stored));
    let said = unusable(&table, "a");
    assert!(said.contains("1000000000000 numbers a point, where at most 4096"), "{said}");
    let vtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 0 float\nPOINT_DATA 0\n\
        FIELD f 1\na 1000000000000 0 float\n";
    let said = unusable(&read("p.vtk", vtk), "a");
    assert!(said.contains("1000000000000 numbers a point"), "{said}");
    let vtu = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"0\"><PointData>\
        <DataArray Name=\"a\" type=\"Float64\" NumberOfComponents=\"1000000000000\"/></PointData></Piece>\
        </UnstructuredGrid></VTKFile>";
    let said = unusable(&read("p.vtu", vtu), "a");
    assert!(said.contains("1000000000000 numbers a point"), "{said}");
}

#[test]
fn dimensions_are_no_more_than_numpy_has() {
    for count in [65, 20_000] {
        let shape = format!("({})", "1, ".repeat(count));
        let mut member = npy(&shape, &[1.0]);
        let order = b"False".as_slice();
        let at = member.windows(order.len()).position(|found| found == order).unwrap();
        member[at..at + order.len()].copy_from_slice(b"True ");
        let members = [("x.npy", npy("(1,)", &[0.0])), ("a.npy", member)];
        let bytes = archive(&members, CompressionMethod::Deflated);
        let said = unusable(&read("p.npz", &bytes), "a");
        assert!(said.contains(&format!("{count} dimensions, where at most 64")), "{said}");
    }
}

/// The deflated bytes of zeros are few, and hundreds of arrays say that they are theirs.
#[test]
fn arrays_that_share_packed_bytes_are_unpacked_no_oftener_than_the_file_can_pay() {
    use std::io::Write;
    let (points, arrays) = (400_000_usize, 200);
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(&vec![0; 3 * points]).unwrap();
    let packed = encoder.finish().unwrap();
    let mut file = String::from(
        "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>",
    );
    file += &format!("<Piece NumberOfPoints=\"{points}\"><Points>");
    let array = |name: String, components: usize| {
        format!(
            "<DataArray Name=\"{name}\" type=\"UInt8\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"0\"/>"
        )
    };
    file += &array("Points".into(), 3);
    file += "</Points><PointData>";
    for number in 0..arrays {
        file += &array(format!("a{number}"), 3);
    }
    file += "</PointData></Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_";
    let mut bytes = file.into_bytes();
    for size in [1, 3 * points, 0, packed.len()] {
        bytes.extend((size as u32).to_le_bytes());
    }
    bytes.extend(packed);
    bytes.extend(b"</AppendedData></VTKFile>");
    let table = read("p.vtu", &bytes);
    let said = unusable(&table, &format!("a{}", arrays - 1));
    assert!(said.contains("to be unpacked, but of what a file of this size can hold"), "{said}");
    assert!(table.quantity("a0").is_ok());
    let kept: usize = table.arrays.iter().map(|array| array.values.len()).sum();
    assert!(kept <= 1032 * bytes.len(), "{kept} of {}", bytes.len());
}

#[test]
fn names_on_one_line_are_looked_at_once() {
    let blocks = 1_000_000;
    let text = format!(
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float 0 0 0 {}",
        "VERTICES 0 0 ".repeat(blocks)
    );
    assert_eq!(without_hanging(move || read("p.vtk", text)).len(), 1);
}

#[test]
fn text_in_pieces_behind_blanks_is_looked_through_once() {
    let (blanks, pieces) = (" ".repeat(3_000_000), "1<!-- -->".repeat(300_000));
    let text = format!(
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\"><Points>\
         <DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points><PointData>\
         <DataArray type=\"Float32\" Name=\"a\" format=\"ascii\">{blanks}{pieces}</DataArray></PointData></Piece>\
         </PolyData></VTKFile>"
    );
    without_hanging(move || read("p.vtp", text));
}

#[test]
fn names_that_are_missing_are_made_up_in_time() {
    let arrays = 4000;
    let taken: String = (0..arrays)
        .map(|number| {
            format!("<DataArray type=\"Float32\" Name=\"array_{arrays}{}\">1</DataArray>", "_".repeat(number))
        })
        .collect();
    let text = format!(
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\"><Points>\
         <DataArray type=\"Float32\" NumberOfComponents=\"3\">0 0 0</DataArray></Points><PointData>\
         {taken}<DataArray type=\"Float32\">1</DataArray></PointData></Piece></PolyData></VTKFile>"
    );
    let table = without_hanging(move || read("p.vtp", text));
    assert!(table.arrays.last().unwrap().name.ends_with("____"));
}

/// A megabyte of zeros in 24 bytes: LZ4 says how little it can hold before a byte is unpacked.
#[test]
fn blocks_of_lz4_that_claim_more_than_they_can_hold_are_refused() {
    let claimed = 1_048_576_usize;
    let mut bytes = format!(
        "<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"><PolyData><Piece NumberOfPoints=\"{}\"><Points>\
         <DataArray type=\"UInt8\" NumberOfComponents=\"4096\" format=\"appended\" offset=\"0\"/></Points></Piece></PolyData>\
         <AppendedData encoding=\"raw\">_",
        claimed / 4096
    )
    .into_bytes();
    for size in [1, claimed, 0, 24] {
        bytes.extend((size as u32).to_le_bytes());
    }
    bytes.extend([0; 24]);
    // Room, so that the file as a whole could hold what is claimed.
    bytes.extend([b' '; 2000]);
    let message = refused("p.vtp", bytes);
    assert!(message.contains("block 0 of 1 has 24 packed bytes, which cannot hold 1048576"), "{message}");
}

#[test]
fn headers_of_numpy_are_not_deeper_than_they_need_to_be() {
    for open in ["(", "[", "{'a':"] {
        let mut bytes = npy("(1, 1)", &[]);
        let text = String::from_utf8_lossy(&bytes[10..]).replace("'<f8'", &open.repeat(10_000));
        bytes.truncate(8);
        bytes.extend((text.len() as u16).to_le_bytes());
        bytes.extend(text.as_bytes());
        let message = without_hanging(move || refused("p.npy", bytes));
        assert!(message.contains("is not one of NumPy"), "{message}");
    }
}

/// A million elements, lists and words that cost nothing to declare.
#[test]
fn declarations_of_text_formats_are_no_more_than_they_are_worth() {
    let elements = "element a 1\n".repeat(1_000_000);
    let message =
        without_hanging(move || refused("p.ply", format!("ply\nformat ascii 1.0\n{elements}end_header\n")));
    assert!(message.contains("line 4099: 4097 arrays or more, where at most 4096 are read"), "{message}");
    let columns = "a:R:1:".repeat(1_000_000);
    let message = without_hanging(move || refused("p.xyz", format!("0\nProperties={columns}b:R:1\n")));
    assert!(message.contains("line 2: 1000001 arrays or more, where at most 4096 are read"), "{message}");
    let words = "1 ".repeat(1_000_000);
    let message = without_hanging(move || refused("p.xyz", format!("1\n\n{words}\n")));
    assert!(message.contains("line 3: 1000000 arrays or more, where at most 4096 are read"), "{message}");
}
