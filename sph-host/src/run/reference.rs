//! Published numbers that the dam break is compared with.

/// Points (T, Z) of one series of the surge front.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Front {
    pub(super) series: &'static str,
    pub(super) points: Vec<[f64; 2]>,
}

/// The file with its sources.
const FRONTS: &str = include_str!("data/dam_break_front.csv");

/// The series of the surge front, each with its points in the order of time.
pub(super) fn fronts() -> Vec<Front> {
    let mut fronts: Vec<Front> = Vec::new();
    for line in FRONTS.lines().filter(|line| !line.starts_with('#')) {
        let mut cells = line.split(',');
        let (Some(series), Some(t), Some(z)) = (cells.next(), cells.next(), cells.next()) else { continue };
        let (Ok(t), Ok(z)) = (t.parse(), z.parse()) else { continue };
        match fronts.last_mut().filter(|front| front.series == series) {
            Some(front) => front.points.push([t, z]),
            None => fronts.push(Front { series, points: vec![[t, z]] }),
        }
    }
    fronts
}

/// The points of one series; none where there is no such series.
pub(super) fn front(series: &str) -> Vec<[f64; 2]> {
    fronts().into_iter().find(|front| front.series == series).map_or_else(Vec::new, |front| front.points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_numbers_are_there_and_in_order() {
        let lengths: Vec<_> = fronts().iter().map(|front| (front.series, front.points.len())).collect();
        let expected = [
            ("martin_moyce_1.125in", 10),
            ("martin_moyce_2.25in", 15),
            ("koshizuka_oka", 9),
            ("koshizuka_oka_mps", 18),
        ];
        assert_eq!(lengths, expected);
        for front in fronts() {
            assert!(front.points.is_sorted_by(|a, b| a[0] < b[0] && a[1] < b[1]), "{}", front.series);
        }
        assert_eq!(front("koshizuka_oka_mps").last(), Some(&[2.943, 3.997]));
    }
}
