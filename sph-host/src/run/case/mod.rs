//! The list of the cases.
//!
//! A case is a file here with a `static CASE: Definition`, and its line in the list below.

use super::definition::Definition;
use super::solver::Solver;
use crate::named_enum::named_enum;

macro_rules! cases {
    ($($Variant:ident in $module:ident, $name:literal, $about:literal;)+) => {
        $(mod $module;)+

        named_enum! {
            /// What can be simulated.
            CaseName { $($Variant, $name, $about;)+ }
        }

        impl CaseName {
            /// What the case's file says of it.
            pub(super) fn definition(self) -> &'static Definition {
                match self {
                    $(Self::$Variant => &$module::CASE,)+
                }
            }
        }

        /// The files of the list.
        #[cfg(test)]
        const MODULES: &[&str] = &[$(stringify!($module)),+];
    };
}

cases! {
    DamBreak in dam_break, "dam-break", "a column of water collapses on a dry bed; front against Koshizuka & Oka (1996)";
    Impact in impact, "impact", "a dam break that hits a wall; pressure there against Buchner's experiment (2002)";
    Hydrostatic in hydrostatic, "hydrostatic", "water at rest in a tank; pressure against ρ g (H − z)";
    Drop in drop, "drop", "a round drop stretched to an ellipse (Monaghan 1994); semi-axes against the exact ones";
    TaylorGreen in taylor_green, "taylor-green", "decaying periodic vortices at Re 100; energy against the exact decay";
    Poiseuille in poiseuille, "poiseuille", "the start of a channel flow (Morris 1997); profile against the series solution";
    Tilt in tilt, "tilt", "a box turned through a script, shown as lamps; height and level against those of the volume put in";
}

impl CaseName {
    /// The dimensions that the case exists in, the default first.
    #[must_use]
    pub fn dimensions(self) -> Vec<usize> {
        [2, 3].into_iter().filter(|&dim| self.resolution(dim).is_some()).collect()
    }

    /// The resolution in so many dimensions unless another is asked for.
    #[must_use]
    pub fn resolution(self, dim: usize) -> Option<u32> {
        let Definition { in_2d, in_3d, .. } = self.definition();
        match dim {
            2 => in_2d.as_ref().map(|form| form.resolution),
            3 => in_3d.as_ref().map(|form| form.resolution),
            _ => None,
        }
    }

    /// How long the case is simulated unless another time is asked for, s.
    #[must_use]
    pub fn duration(self) -> f64 {
        (self.definition().duration)()
    }

    /// The length that the resolution counts particles across.
    #[must_use]
    pub fn across(self) -> &'static str {
        self.definition().across
    }

    /// The solver in so many dimensions unless another is asked for.
    #[must_use]
    pub fn solver(self, dim: usize) -> Option<Solver> {
        let Definition { in_2d, in_3d, .. } = self.definition();
        match dim {
            2 => in_2d.as_ref().map(|form| form.solver),
            3 => in_3d.as_ref().map(|form| form.solver),
            _ => None,
        }
    }

    /// The solvers that can simulate the case.
    #[must_use]
    pub fn solvers(self) -> &'static [Solver] {
        self.definition().solvers
    }

    /// The columns of the series that only this case has.
    #[must_use]
    pub fn columns(self) -> &'static [&'static str] {
        self.definition().columns
    }

    /// The file of the plot against the reference.
    #[must_use]
    pub fn plot(self) -> &'static str {
        self.definition().plot
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;

    #[test]
    fn every_file_of_a_case_is_in_the_list() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/run/case");
        let files: BTreeSet<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
            .filter(|stem| stem != "mod")
            .collect();
        assert_eq!(files, MODULES.iter().map(|&module| module.to_owned()).collect());
    }

    #[test]
    fn cases_do_not_share_names_or_plots() {
        let distinct = |items: Vec<&str>| items.iter().collect::<BTreeSet<_>>().len();
        let count = CaseName::ALL.len();
        assert_eq!(distinct(CaseName::ALL.iter().map(|case| case.name()).collect()), count);
        assert_eq!(distinct(CaseName::ALL.iter().map(|case| case.plot()).collect()), count);
    }

    #[test]
    fn every_case_can_be_simulated_and_resolved() {
        for case in CaseName::ALL {
            assert!(!case.dimensions().is_empty(), "{case}");
            for dim in case.dimensions() {
                let [least, most] = crate::run::resolutions(dim);
                assert!(case.resolution(dim).is_some_and(|usual| (least..=most).contains(&usual)), "{case}");
                assert!(case.solver(dim).is_some_and(|usual| case.solvers().contains(&usual)), "{case}");
            }
        }
    }

    #[test]
    fn validation_has_a_table_for_every_case_and_solver() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/validation.md");
        let text = std::fs::read_to_string(path).unwrap();
        for case in CaseName::ALL {
            let title = format!("`fluisim run {case}`");
            let section = text
                .split("\n## ")
                .find(|section| section.lines().next().is_some_and(|line| line.ends_with(&title)));
            let section = section.unwrap_or_else(|| panic!("no section titled {title}"));
            assert!(section.lines().filter(|line| line.starts_with('|')).count() > 2, "{case}: no table");
            let usual = case.dimensions().first().and_then(|&dim| case.solver(dim));
            for solver in case.solvers().iter().filter(|&&solver| Some(solver) != usual) {
                assert!(section.contains(&format!("solver {solver}")), "{case}: nothing on {solver}");
            }
        }
    }
}
