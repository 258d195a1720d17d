//! The lists hold everything that there is: nothing can be added to the folders and forgotten there.

use sph_core::kernel::{self, Kernel};
use std::collections::BTreeSet;
use std::path::Path;

/// The kernels' modules and types.
fn listed() -> Vec<(&'static str, String)> {
    macro_rules! modules {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
            vec![$((stringify!($module), format!("{:?}", kernel::$Kernel)),)+]
        };
    }
    sph_core::for_each_kernel!(modules)
}

/// Files of the folder that are no kernels.
const OTHERS: [&str; 4] = ["mod", "conformance", "moment", "tabulated"];

#[test]
fn every_file_in_the_kernels_folder_is_in_the_list() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/kernel");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .filter(|file| !OTHERS.contains(&file.as_str()))
        .collect();
    let listed: BTreeSet<String> = listed().iter().map(|(module, _)| (*module).to_owned()).collect();
    assert_eq!(files, listed, "a kernel's file needs its line in `for_each_kernel`");
}

/// `wendland_c2`, `WendlandC2` and `wendland-c2`.
#[test]
fn names_are_those_of_modules_and_types() {
    assert_eq!(listed().len(), kernel::LIST.len());
    for ((module, of_type), (name, about)) in listed().into_iter().zip(kernel::LIST) {
        assert_eq!(*name, module.replace('_', "-"));
        assert_eq!(of_type.to_lowercase(), module.replace('_', ""));
        assert!(about.len() > 10, "{name} needs a description");
    }
}

/// A kernel without a pole says so and has a norm; one with a pole is refused.
#[test]
fn only_singular_kernels_diverge() {
    macro_rules! at_zero {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {$(
            assert_eq!(kernel::$Kernel::SINGULAR, !kernel::$Kernel::profile(0.0_f64).is_finite(), $name);
            let made = sph_core::KernelInfluence::<f64, 3, kernel::$Kernel>::new(1.0);
            assert_eq!(made.is_err(), kernel::$Kernel::SINGULAR, $name);
        )+};
    }
    sph_core::for_each_kernel!(at_zero);
}

/// Names of scalars are unique, and each number type is told from every other.
#[test]
fn scalars_have_names_of_their_own() {
    macro_rules! names {
        ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => {
            vec![$((<$Scalar as sph_core::Scalar>::NAME, stringify!($Name), $about),)+]
        };
    }
    let scalars = sph_core::for_each_scalar!(names);
    assert_eq!(scalars.iter().map(|scalar| scalar.0).collect::<BTreeSet<_>>().len(), scalars.len());
    for (name, variant, about) in scalars {
        assert_eq!(name, variant.to_lowercase());
        assert!(about.contains("point"), "{name}: {about}");
    }
}
