//! A study in pictures: read from afar, drawn on logarithmic axes.

use sph_lab::Rounding;

use super::formats::NumberFormat;
use super::measure::name_of;
use super::request::Quantity;
use super::{Insight, Row, Study};
use crate::kernel_choice::KernelName;
use crate::picture::plot::{self, Mark, Plot, Series};
use crate::picture::spectrum::{self, Spectrum};
use crate::picture::{Image, PictureError};

/// Places of the histograms at most.
const MOST_PLACES: usize = 40;

impl Study {
    /// Every picture with its file name.
    ///
    /// # Errors
    /// What drawing reports.
    pub fn pictures(&self) -> Result<Vec<(&'static str, Image)>, PictureError> {
        let mut pictures = vec![("errors.png", self.draw_errors()?), ("front.png", self.draw_front()?)];
        if let Some(insight) = &self.insight {
            pictures.push(("bits.png", insight.draw_bits()?));
            pictures.push(("units.png", self.draw_units(insight)?));
        }
        if let Some(image) = self.draw_roundings()? {
            pictures.push(("rounding.png", image));
        }
        Ok(pictures)
    }

    /// Rows of fixed point rounded to nearest and saturating, of one kernel.
    fn rows_of(&self, kernel: KernelName) -> impl Iterator<Item = &Row> {
        let first = self.rows.iter().find_map(|row| match row.format {
            NumberFormat::Fixed(format) => Some((format.rounding(), format.overflow())),
            NumberFormat::Mini(_) => None,
        });
        self.rows.iter().filter(move |row| {
            let is_first = matches!(row.format, NumberFormat::Fixed(format)
                if Some((format.rounding(), format.overflow())) == first);
            row.kernel == kernel && is_first
        })
    }

    /// The kernels that have rows.
    fn kernels(&self) -> Vec<KernelName> {
        KernelName::ALL.iter().copied().filter(|&kernel| self.rows_of(kernel).next().is_some()).collect()
    }

    /// A plot of errors over bits for one quantity, with its goal.
    fn over_bits(&self, quantity: Quantity, goal: f64, mut series: Vec<Series>) -> Plot {
        let bits = series.iter().flat_map(|one| &one.points).map(|point| point[0]);
        let (least, most) =
            bits.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
        let goal =
            Series { name: String::new(), points: vec![[least, goal], [most, goal]], mark: Mark::Line };
        series.push(goal);
        Plot {
            title: format!("{quantity}: {}", quantity.about()),
            x_title: "bits".into(),
            y_title: "largest relative error".into(),
            series,
            logarithmic: [false, true],
            ..Plot::default()
        }
    }

    /// Error against bits, kernel by kernel; the goal as a line without a name.
    fn draw_errors(&self) -> Result<Image, PictureError> {
        let plots = self.goals.iter().map(|&(quantity, goal)| {
            let series = self.kernels().into_iter().map(|kernel| {
                let points =
                    self.rows_of(kernel).filter_map(|row| point(row, row.format.bits().into(), quantity));
                Series { name: kernel.name().to_owned(), points: points.collect(), mark: Mark::Line }
            });
            self.over_bits(quantity, goal, series.collect())
        });
        plot::draw(
            &format!("{}: error against bits; without a name: the goal", self.file),
            &[plots.collect()],
        )
    }

    /// How far from the goals against what a pair costs, or against bytes where nothing was counted.
    fn draw_front(&self) -> Result<Image, PictureError> {
        let is_counted = self.rows.iter().any(|row| row.instructions.is_some());
        let cost = |row: &Row| match row.instructions {
            Some(counted) => Some(counted.density + counted.gradient),
            None => (!is_counted).then(|| f64::from(row.bytes)),
        };
        let series = self.kernels().into_iter().map(|kernel| {
            let rows = self.rows.iter().filter(|row| row.kernel == kernel);
            let points = rows.filter_map(|row| {
                let short = row.shortfall(&self.goals);
                Some([cost(row)?, short]).filter(|_| short.is_finite())
            });
            Series { name: kernel.name().to_owned(), points: points.collect(), mark: Mark::Points }
        });
        let mut series: Vec<Series> = series.collect();
        let costs: Vec<f64> = series.iter().flat_map(|one| &one.points).map(|point| point[0]).collect();
        let ends = costs.iter().fold([f64::INFINITY, 0.0], |[least, most], &x| [least.min(x), most.max(x)]);
        series.push(Series {
            name: String::new(),
            points: vec![[ends[0], 1.0], [ends[1], 1.0]],
            mark: Mark::Line,
        });
        let x_title = if is_counted {
            format!("instructions of a pair on {}, density and gradient", self.target)
        } else {
            String::from("bytes of a particle")
        };
        let plot = Plot {
            title: String::from("below the line all goals are met"),
            x_title,
            y_title: String::from("largest error over its goal"),
            series,
            logarithmic: [false, true],
            ..Plot::default()
        };
        plot::draw(&format!("{}: error against cost", self.file), &[vec![plot]])
    }

    /// The error against the unit of length, with the most bits.
    fn draw_units(&self, insight: &Insight) -> Result<Image, PictureError> {
        let series = self.goals.iter().flat_map(|&(quantity, _)| {
            let of = |trial: &super::UnitTrial, x: f64| {
                let error = trial.errors.as_ref()?[quantity.index()].largest;
                Some([x, error]).filter(|_| error.is_finite() && error > 0.0)
            };
            let proposed = insight.units.iter().filter_map(|trial| of(trial, trial.support?)).collect();
            let own: Vec<[f64; 2]> = insight
                .units
                .iter()
                .filter_map(|trial| if trial.support.is_some() { None } else { of(trial, 1.0) })
                .flat_map(|[_, error]| [[1.0, error], [3.0, error]])
                .collect();
            [
                Series { name: quantity.name().to_owned(), points: proposed, mark: Mark::Line },
                Series { name: format!("{quantity}, file's units"), points: own, mark: Mark::Line },
            ]
        });
        let plot = Plot {
            title: format!(
                "{}, {} bits",
                insight.kernel,
                self.rows.iter().map(|row| row.format.bits()).max().unwrap_or(0)
            ),
            x_title: String::from("support radius in units of length"),
            y_title: String::from("largest relative error"),
            series: series.collect(),
            logarithmic: [false, true],
            ..Plot::default()
        };
        plot::draw(&format!("{}: error against the unit of length", self.file), &[vec![plot]])
    }

    /// Error and bias by rounding, where there is more than one.
    fn draw_roundings(&self) -> Result<Option<Image>, PictureError> {
        let kernel = self.insight.as_ref().map(|insight| insight.kernel);
        let mut roundings: Vec<Rounding> = Vec::new();
        for row in &self.rows {
            if let NumberFormat::Fixed(format) = row.format
                && !roundings.contains(&format.rounding())
            {
                roundings.push(format.rounding());
            }
        }
        if roundings.len() < 2 {
            return Ok(None);
        }
        let plots = self.goals.iter().map(|&(quantity, goal)| {
            let series = roundings.iter().map(|&rounding| {
                let rows = self.rows.iter().filter(|row| {
                    Some(row.kernel) == kernel
                        && matches!(row.format, NumberFormat::Fixed(format) if format.rounding() == rounding)
                });
                let points = rows.filter_map(|row| point(row, row.format.bits().into(), quantity)).collect();
                Series { name: rounding.to_string(), points, mark: Mark::Line }
            });
            self.over_bits(quantity, goal, series.collect())
        });
        let title = format!("{}: error against bits by rounding", self.file);
        Ok(Some(plot::draw(&title, &[plots.collect()])?))
    }
}

/// A row's place in a plot of errors.
fn point(row: &Row, x: f64, quantity: Quantity) -> Option<[f64; 2]> {
    let error = row.errors.as_ref().ok()?[quantity.index()].largest;
    (error.is_finite() && error > 0.0).then_some([x, error])
}

impl Insight {
    /// The bits that each place uses, between the ends of the format.
    fn draw_bits(&self) -> Result<Image, PictureError> {
        let mut records: Vec<_> =
            self.log.places().iter().filter(|record| record.exponents().next().is_some()).collect();
        records.sort_by_key(|record| std::cmp::Reverse(record.count));
        records.truncate(MOST_PLACES);
        records.sort_by(|a, b| b.largest().total_cmp(&a.largest()));
        let rows = records.into_iter().map(|record| spectrum::Row {
            label: name_of(&record.place),
            counts: record.exponents().collect(),
        });
        let (lowest, highest) =
            (-f64::from(self.format.fraction_bits()), f64::from(self.format.integer_bits()) - 1.0);
        spectrum::draw(&Spectrum {
            title: format!("{}, {}: bits used, place by place", self.kernel, self.format),
            rows: rows.collect(),
            marks: vec![(lowest, String::from("last bit")), (highest, String::from("end of range"))],
        })
    }
}
