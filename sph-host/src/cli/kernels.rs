//! `fluisim kernels`: the kernels' constants as a table, as CSV, or as a picture.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::failure::Failure;
use super::to_stdout;
use crate::kernel_choice::KernelName;
use crate::output::{Format, Precision, Target, shortest};
use crate::picture::plot::{self, Mark, Plot, Series};

/// List the kernels: name, normalisation, support ratio, moments.
///
/// normalisation is σ_D, such that W = σ_D h^{-D} f(r/h) integrates to 1; support_ratio is support radius / smoothing length;
/// profile_at_zero is f(0), empty where it diverges; second_moment is ∫ |x|² W d^Dx for support radius 1.
///
/// Example: fluisim kernels --dim 3 --format csv
#[derive(Debug, Args)]
pub(super) struct KernelsArgs {
    /// Dimensions, 1 to 8; without it 1, 2 and 3
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=8))]
    dim: Option<u32>,
    /// How the constants are printed
    #[arg(long, value_enum, default_value_t = TableFormat::Table)]
    format: TableFormat,
    /// Draw the profiles f(q) and slopes f′(q) to this .png
    #[arg(long, value_name = "FILE.png")]
    plot: Option<PathBuf>,
    /// Replace an existing picture
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum TableFormat {
    /// aligned columns for people
    Table,
    /// comma-separated values that read back to the same bits
    Csv,
}

/// The constants of one kernel in one dimension.
struct Row {
    kernel: KernelName,
    dim: u32,
}

const HEADER: [&str; 6] =
    ["name", "dim", "normalisation", "support_ratio", "profile_at_zero", "second_moment"];

impl Row {
    /// The cells under [`HEADER`].
    fn cells(&self) -> [String; 6] {
        let number = |value: f64| shortest(value, Precision::F64);
        let at_zero = if self.kernel.is_singular() { f64::NAN } else { self.kernel.profile(self.dim, 0.0) };
        [
            self.kernel.name().to_owned(),
            self.dim.to_string(),
            number(self.kernel.normalisation(self.dim)),
            number(self.kernel.support_ratio()),
            number(at_zero),
            number(self.kernel.second_moment(self.dim)),
        ]
    }
}

/// Prints the constants, and draws the kernels if `--plot` is given.
pub(super) fn run(args: &KernelsArgs) -> Result<(), Failure> {
    let dims = args.dim.map_or_else(|| vec![1, 2, 3], |dim| vec![dim]);
    if let Some(path) = &args.plot {
        if Format::of(path).is_none_or(|format| format.ending != ".png") {
            return Err(Failure::usage(format!("--plot {}: the file's ending must be .png", path.display())));
        }
        draw(args.dim.unwrap_or(3), &Target { path: path.clone(), force: args.force })?;
    }
    let rows: Vec<Row> = dims
        .iter()
        .flat_map(|&dim| KernelName::ALL.iter().map(move |&kernel| Row { kernel, dim }))
        // the viscosity kernel has no norm in one dimension
        .filter(|row| !(row.kernel.is_singular() && row.dim == 1))
        .collect();
    let stdout = io::stdout().lock();
    to_stdout(match args.format {
        TableFormat::Csv => print_csv(&rows, stdout),
        TableFormat::Table => print_table(&rows, stdout),
    })
}

fn print_csv(rows: &[Row], mut out: impl Write) -> io::Result<()> {
    writeln!(out, "{}", HEADER.join(","))?;
    rows.iter().try_for_each(|row| writeln!(out, "{}", row.cells().join(",")))
}

fn print_table(rows: &[Row], mut out: impl Write) -> io::Result<()> {
    let lines: Vec<[String; 6]> =
        std::iter::once(HEADER.map(String::from)).chain(rows.iter().map(Row::cells)).collect();
    let widths: [usize; 6] =
        std::array::from_fn(|column| lines.iter().map(|line| line[column].len()).max().unwrap_or_default());
    lines.iter().try_for_each(|line| {
        let cells: Vec<String> =
            line.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        writeln!(out, "{}", cells.join("  ").trim_end())
    })
}

/// Profiles and slopes side by side; the pole of the viscosity kernel is cut off.
fn draw(dim: u32, target: &Target) -> Result<(), Failure> {
    target.check_place()?;
    let plot = |title: &str, y_title: &str, y_range, f: &dyn Fn(KernelName, f64) -> f64| Plot {
        title: title.into(),
        x_title: "q = r / h".into(),
        y_title: y_title.into(),
        series: KernelName::ALL.iter().map(|&kernel| series(kernel, f)).collect(),
        x_range: Some([0.0, 1.0]),
        y_range: Some(y_range),
        ..Plot::default()
    };
    let profile = plot("profile", "f(q)", [0.0, 1.05], &|kernel, q| kernel.profile(dim, q));
    let slope = plot("slope", "f′(q)", [-4.0, 0.1], &|kernel, q| kernel.slope(dim, q));
    let image = plot::draw(&format!("Kernels in {dim} dimensions"), &[vec![profile, slope]])
        .map_err(|error| Failure::input(format!("{}: {error}", target.path.display())))?;
    Ok(target.create(|file| image.write_png(file))?)
}

fn series(kernel: KernelName, f: &dyn Fn(KernelName, f64) -> f64) -> Series {
    let points = (1..=300).map(|i| f64::from(i) / 300.0).map(|q| [q, f(kernel, q)]).collect();
    Series { name: kernel.name().to_owned(), points, mark: Mark::Line }
}
