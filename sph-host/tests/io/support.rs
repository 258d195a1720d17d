//! Files made for a test.

use std::io::{Cursor, Write};
use std::path::PathBuf;

use sph_host::io::{self, PointTable, ReadError};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// A file in a folder of its own.
pub(crate) struct File(tempfile::TempDir, pub(crate) PathBuf);

impl File {
    pub(crate) fn new(name: &str, content: impl AsRef<[u8]>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        Self(folder, path)
    }

    /// Makes the file anew: some file systems wait for the disk where a file is cut and written again.
    pub(crate) fn rewrite(&self, content: &[u8]) {
        std::fs::remove_file(&self.1).unwrap();
        std::fs::write(&self.1, content).unwrap();
    }

    pub(crate) fn read(&self) -> Result<PointTable, ReadError> {
        io::read(&self.1)
    }

    /// All pieces of two points, or the first error.
    pub(crate) fn pieces(&self) -> Result<Vec<PointTable>, ReadError> {
        io::Pieces::open(&self.1, 2)?.collect()
    }
}

pub(crate) fn read(name: &str, content: impl AsRef<[u8]>) -> PointTable {
    File::new(name, content).read().unwrap()
}

/// The message for a file that cannot be read, without the folder's name.
pub(crate) fn refused(name: &str, content: impl AsRef<[u8]>) -> String {
    let file = File::new(name, content);
    let message = file.read().unwrap_err().to_string();
    let folder = format!("{}/", file.0.path().display());
    message.strip_prefix(&folder).unwrap_or_else(|| panic!("{message}")).to_owned()
}

/// The message for a quantity that cannot be used, without the file's name.
pub(crate) fn unusable(table: &PointTable, name: &str) -> String {
    let message = table.quantity(name).unwrap_err().to_string();
    message.strip_prefix(&format!("{}: ", table.source)).unwrap_or_else(|| panic!("{message}")).to_owned()
}

pub(crate) fn values(table: &PointTable, name: &str) -> Vec<f64> {
    table.quantity(name).unwrap().values.into_owned()
}

/// A `.npy` file of doubles.
pub(crate) fn npy(shape: &str, values: &[f64]) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
    let mut bytes = b"\x93NUMPY\x01\0".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

pub(crate) fn archive(members: &[(&str, Vec<u8>)], method: CompressionMethod) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        archive.start_file(*name, SimpleFileOptions::default().compression_method(method)).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

pub(crate) fn three_points(more: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let x = ("x.npy", npy("(3,)", &[0.0, 0.5, 1.0]));
    archive(&[&[x], more].concat(), CompressionMethod::Stored)
}

pub(crate) const BOTH: [CompressionMethod; 2] = [CompressionMethod::Stored, CompressionMethod::Deflated];

pub(crate) fn vtu(pieces: &[(usize, &str)]) -> String {
    let points = |count: usize| (0..count).map(|i| format!("{i} 0 0 ")).collect::<String>();
    let pieces = pieces.iter().map(|&(count, arrays)| {
        format!(
            "<Piece NumberOfPoints=\"{count}\"><PointData>{arrays}</PointData><Points>\
             <DataArray type=\"Float64\" NumberOfComponents=\"3\">{}</DataArray></Points></Piece>",
            points(count)
        )
    });
    let pieces: String = pieces.collect();
    format!("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>{pieces}</UnstructuredGrid></VTKFile>")
}

pub(crate) fn array(name: &str, text: &str) -> String {
    format!("<DataArray type=\"Float64\" Name=\"{name}\" format=\"ascii\">{text}</DataArray>")
}

pub(crate) const VTK: &str = "# vtk DataFile Version 3.0\nt\nASCII\n";
