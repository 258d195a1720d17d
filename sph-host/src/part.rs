//! One of several parts of the work, for a process each.

use std::ops::Range;
use std::str::FromStr;

/// The K-th of N parts of a list: equal shares on end.
///
/// ```
/// use sph_host::part::Part;
///
/// let part: Part = "2/3".parse()?;
/// assert_eq!(part.range(10), 3..6);
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    number: usize,
    of: usize,
}

/// Where launchers tell a process its rank and how many there are: names of environment variables, and the first rank.
const LAUNCHERS: [(&str, &str, usize); 4] = [
    ("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", 0),
    ("PMI_RANK", "PMI_SIZE", 0),
    ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", 1),
    ("SLURM_PROCID", "SLURM_NTASKS", 0),
];

impl Part {
    /// Part `number`, from 1, of `of`.
    ///
    /// # Errors
    /// There is no such part.
    pub fn new(number: usize, of: usize) -> Result<Self, String> {
        if (1..=of).contains(&number) {
            Ok(Self { number, of })
        } else {
            Err(format!("there is no part {number} of {of}: the first is 1, the last {of}"))
        }
    }

    /// The part of this process by what a launcher told it: `mpirun` (Open MPI, MPICH), a SLURM array that begins at 1, `srun`.
    ///
    /// # Errors
    /// No launcher told anything that could be.
    pub fn of_launcher(variable: impl Fn(&str) -> Option<String>) -> Result<Self, String> {
        let told = LAUNCHERS
            .iter()
            .find_map(|&(rank, size, first)| Some((rank, variable(rank)?, size, variable(size)?, first)));
        let Some((rank_name, rank, size_name, size, first)) = told else {
            let names: Vec<String> =
                LAUNCHERS.iter().map(|(rank, size, _)| format!("{rank} and {size}")).collect();
            return Err(format!("no launcher says which part this is, by {}", names.join(", or ")));
        };
        let told = format!("{rank_name}={rank} and {size_name}={size}");
        match (rank.parse::<usize>(), size.parse()) {
            (Ok(rank), Ok(size)) => Self::new((rank + 1).saturating_sub(first), size)
                .map_err(|problem| format!("{told}: {problem}")),
            _ => Err(format!("{told}: two whole numbers are expected")),
        }
    }

    /// Its number, from 1.
    #[must_use]
    pub fn number(self) -> usize {
        self.number
    }

    /// How many parts there are.
    #[must_use]
    pub fn of(self) -> usize {
        self.of
    }

    /// All parts in order.
    pub fn all(self) -> impl Iterator<Item = Self> {
        (1..=self.of).map(move |number| Self { number, ..self })
    }

    /// Its share of so many things.
    #[must_use]
    pub fn range(self, things: usize) -> Range<usize> {
        let cut = |parts: usize| (things as u128 * parts as u128 / self.of as u128) as usize;
        cut(self.number - 1)..cut(self.number)
    }

    /// Its share of the layers of a grid; where layers are shared, the first of the next part too, so that no gap is between.
    #[must_use]
    pub fn layers(self, layers: usize, are_shared: bool) -> Range<usize> {
        let Range { start, end } = self.range(layers);
        start..if are_shared { (end + 1).min(layers) } else { end }
    }
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').map(|(number, of)| (number.trim().parse(), of.trim().parse()));
        match numbers {
            Some((Ok(number), Ok(of))) => Self::new(number, of),
            _ => Err("expected K/N, such as 2/4".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_everything_once() {
        for (things, of) in [(10, 3), (3, 3), (2, 5), (0, 2), (1_000_003, 7)] {
            let all: Vec<Range<usize>> =
                Part::new(1, of).unwrap().all().map(|part| part.range(things)).collect();
            assert_eq!((all[0].start, all[of - 1].end), (0, things));
            assert!(all.windows(2).all(|pair| pair[0].end == pair[1].start));
            let lengths = all.iter().map(Range::len);
            assert!(lengths.clone().max().unwrap() - lengths.min().unwrap() <= 1);
        }
        let part = Part::new(1, 2).unwrap();
        assert_eq!((part.layers(4, true), part.layers(4, false)), (0..3, 0..2));
        assert_eq!(Part::new(2, 2).unwrap().layers(4, true), 2..4);
    }

    #[test]
    fn there_are_words_for_parts() {
        assert_eq!("2/4".parse(), Part::new(2, 4));
        for wrong in ["", "2", "0/4", "5/4", "1/0", "a/4", "1/4/2", "-1/4"] {
            assert!(wrong.parse::<Part>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn launchers_tell_ranks() {
        let told = |pairs: &'static [(&str, &str)]| {
            Part::of_launcher(|name| {
                pairs.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).into())
            })
        };
        assert_eq!(told(&[("OMPI_COMM_WORLD_RANK", "0"), ("OMPI_COMM_WORLD_SIZE", "4")]), Part::new(1, 4));
        assert_eq!(told(&[("SLURM_ARRAY_TASK_ID", "3"), ("SLURM_ARRAY_TASK_COUNT", "3")]), Part::new(3, 3));
        let both = &[("SLURM_PROCID", "0"), ("SLURM_NTASKS", "1"), ("PMI_RANK", "1"), ("PMI_SIZE", "2")];
        assert_eq!(told(both), Part::new(2, 2), "mpirun under SLURM");
        assert!(told(&[("PMI_RANK", "1")]).unwrap_err().contains("SLURM_PROCID"));
        assert!(told(&[("PMI_RANK", "2"), ("PMI_SIZE", "2")]).unwrap_err().contains("PMI_RANK=2"));
        assert!(told(&[("PMI_RANK", "a"), ("PMI_SIZE", "2")]).is_err());
    }
}
