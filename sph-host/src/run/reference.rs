//! Published numbers that dam breaks are compared with.

/// Points (T, value) of one series.
#[derive(Clone, Debug, PartialEq)]
struct Published {
    series: &'static str,
    points: Vec<[f64; 2]>,
}

/// Surge fronts (T, Z), with their sources.
const FRONTS: &str = include_str!("data/dam_break_front.csv");

/// Pressures on a wall (T, P), with their sources.
const PRESSURES: &str = include_str!("data/impact_pressure.csv");

/// The series of a file, each with its points in the order of time.
fn series_of(file: &'static str) -> Vec<Published> {
    let mut all: Vec<Published> = Vec::new();
    for line in file.lines().filter(|line| !line.starts_with('#')) {
        let mut cells = line.split(',');
        let (Some(series), Some(t), Some(z)) = (cells.next(), cells.next(), cells.next()) else { continue };
        let (Ok(t), Ok(z)) = (t.parse(), z.parse()) else { continue };
        match all.last_mut().filter(|known| known.series == series) {
            Some(known) => known.points.push([t, z]),
            None => all.push(Published { series, points: vec![[t, z]] }),
        }
    }
    all
}

fn points(file: &'static str, series: &str) -> Vec<[f64; 2]> {
    series_of(file)
        .into_iter()
        .find(|known| known.series == series)
        .map_or_else(Vec::new, |known| known.points)
}

/// The points of one surge front; none where there is no such series.
pub(super) fn front(series: &str) -> Vec<[f64; 2]> {
    points(FRONTS, series)
}

/// Buchner's pressure on the wall.
pub(super) fn impact() -> Vec<[f64; 2]> {
    points(PRESSURES, "buchner")
}

/// Root mean square of Z/Z_reference − 1 over the reference's points with T > 0 and Z ≤ 4; `None` where `z_at` does not have them all.
pub(super) fn deviation(reference: &[[f64; 2]], z_at: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let points = reference.iter().filter(|&&[t, z]| t > 0.0 && z <= 4.0);
    let squares: Option<Vec<f64>> = points.map(|&[t, z]| Some((z_at(t)? / z - 1.0).powi(2))).collect();
    let squares = squares.filter(|squares| !squares.is_empty())?;
    Some((squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// How far Koshizuka and Oka's computation is from their experiment, at the points of the experiment that it covers.
pub(super) fn computation_against_experiment() -> f64 {
    let computed = front("koshizuka_oka_mps");
    let covered = computed.last().map_or(0.0, |point| point[0]);
    let experiment: Vec<[f64; 2]> =
        front("koshizuka_oka").into_iter().filter(|point| point[0] <= covered).collect();
    deviation(&experiment, |t| between(&computed, t)).unwrap_or(f64::NAN)
}

/// The value at a place, between points by a straight line.
fn between(points: &[[f64; 2]], x: f64) -> Option<f64> {
    let [[x0, y0], [x1, y1]] = points.windows(2).find_map(|pair| match pair {
        &[a, b] if (a[0]..=b[0]).contains(&x) => Some([a, b]),
        _ => None,
    })?;
    Some(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_numbers_are_there_and_in_order() {
        let lengths: Vec<_> =
            series_of(FRONTS).iter().map(|front| (front.series, front.points.len())).collect();
        let expected = [
            ("martin_moyce_1.125in", 10),
            ("martin_moyce_2.25in", 15),
            ("koshizuka_oka", 9),
            ("koshizuka_oka_mps", 18),
        ];
        assert_eq!(lengths, expected);
        for front in series_of(FRONTS) {
            assert!(front.points.is_sorted_by(|a, b| a[0] < b[0] && a[1] < b[1]), "{}", front.series);
        }
        assert_eq!(front("koshizuka_oka_mps").last(), Some(&[2.943, 3.997]));
        let pressures = impact();
        assert_eq!((pressures.len(), pressures.last()), (45, Some(&[5.692, 0.633])));
        assert!(pressures.is_sorted_by(|a, b| a[0] < b[0]));
    }

    #[test]
    fn koshizuka_and_oka_compute_what_is_13_8_percent_from_their_experiment() {
        assert!(
            (computation_against_experiment() - 0.138).abs() < 5e-4,
            "{}",
            computation_against_experiment()
        );
    }
}
