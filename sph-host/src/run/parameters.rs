//! What makes a run the run it is, as `run.json` has it.

use serde_json::{Map, Value, json};

use super::case::CaseName;
use super::solver::Solver;
use crate::kernel_choice::KernelName;
use crate::scalar_choice::ScalarName;

/// What makes a run the run it is. With the same parameters every file has the same bytes, but for the time that it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameters {
    pub(super) case: CaseName,
    pub(super) solver: Solver,
    pub(super) dim: usize,
    pub(super) resolution: u32,
    pub(super) scalar: ScalarName,
    pub(super) kernel: KernelName,
    /// Seconds from frame to frame.
    pub(super) every: f64,
    /// Seconds to simulate.
    pub(super) time: f64,
}

impl Parameters {
    /// As an object of JSON.
    pub(super) fn to_json(self) -> Map<String, Value> {
        let pairs = [
            ("case", json!(self.case.name())),
            ("solver", json!(self.solver.name())),
            ("dim", json!(self.dim)),
            ("resolution", json!(self.resolution)),
            ("scalar", json!(self.scalar.name())),
            ("kernel", json!(self.kernel.name())),
            ("every", json!(self.every)),
            ("time", json!(self.time)),
        ];
        pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Back from JSON; `None` where something is missing or not known.
    pub(super) fn of_json(json: &Value) -> Option<Self> {
        let positive = |name: &str| json[name].as_f64().filter(|value| value.is_finite() && *value > 0.0);
        Some(Self {
            case: CaseName::of_name(json["case"].as_str()?)?,
            solver: Solver::of_name(json["solver"].as_str()?)?,
            dim: json["dim"].as_u64()?.try_into().ok()?,
            resolution: json["resolution"].as_u64()?.try_into().ok()?,
            scalar: ScalarName::of_name(json["scalar"].as_str()?)?,
            kernel: KernelName::of_name(json["kernel"].as_str()?)?,
            every: positive("every")?,
            time: positive("time")?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back_to_the_bit() {
        for every in [0.004, 0.02 / 50.0, 1e-3 / 3.0, 0.1 + 0.2] {
            let parameters = Parameters {
                case: CaseName::ALL[1],
                solver: Solver::Wcsph,
                dim: 2,
                resolution: 40,
                scalar: ScalarName::F32,
                kernel: KernelName::WendlandC4,
                every,
                time: 50.0 * every,
            };
            let text = Value::Object(parameters.to_json()).to_string();
            assert_eq!(Parameters::of_json(&serde_json::from_str(&text).unwrap()), Some(parameters));
        }
        assert_eq!(Parameters::of_json(&json!({"case": "dam-break"})), None);
    }
}
