use super::portable::Portable;
use super::*;
use sph_core::Arithmetic;

/// Numbers of every kind that comparisons and signs treat in their own way.
fn numbers<T: Real>() -> ([T; BLOCK], [T; BLOCK]) {
    let nan = T::ZERO / T::ZERO;
    let a = [1.5, -2.25, 0.0, -0.0, 7.0, 0.1, -0.3, 1e-3, 12.0, 5.0, -1.0, 3.0, 0.7, -0.0, 2.0, 1.0 / 3.0];
    let b = [1.5, 3.0, -0.0, 0.0, -7.0, 0.2, 0.4, -0.1, 0.0, 9.0, 6.0, 0.3, 0.7, 1.0, 0.6, 0.9];
    let (mut a, mut b) = (a.map(T::from_f64), b.map(T::from_f64));
    (a[9], b[12]) = (nan, nan);
    (a, b)
}

/// Everything that a register and an instruction set can do, in one list of bits.
struct Everything;

impl<T: Real> Job<T> for Everything {
    type Output = Vec<u64>;

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) -> Vec<u64> {
        let (a, b) = numbers::<T>();
        let quadruples: [[T; 4]; BLOCK] =
            std::array::from_fn(|k| std::array::from_fn(|number| T::from_f64((10 * k + number) as f64)));
        let places: [u32; BLOCK] = std::array::from_fn(|k| 100 + k as u32);
        // columns by operation, and packed numbers, whose lengths depend on the numbers alone
        let mut columns = vec![Vec::new(); 18];
        let (mut packed, mut packed_places, mut mask) = (Vec::new(), Vec::new(), 0);
        let mut sums = I::parts(I::Reg::EMPTY);
        for part in 0..I::PARTS {
            let first = part * I::Reg::WIDTH;
            let (x, y) = (I::Reg::load_at(&a, first), I::Reg::load_at(&b, first));
            let mut assigned = x;
            assigned += y;
            assigned -= I::Reg::splat(T::ratio(1, 4));
            let [p, q, r, s] = isa.transpose(|k| &quadruples[first + k]);
            let results = [
                x + y,
                x - y,
                x * y,
                x / y,
                -x,
                assigned,
                x.min(y),
                x.max(y),
                (x * x).root(),
                x.positive_part(),
                x.times(3),
                x.where_above_zero(y),
                I::Reg::ratio(1, 3) * I::Reg::ONE,
                I::Reg::ZERO,
                p,
                q,
                r,
                s,
            ];
            for (column, result) in columns.iter_mut().zip(results) {
                let mut out = vec![T::ZERO; I::Reg::WIDTH];
                result.store(&mut out);
                column.extend(out);
            }
            let below = isa.less_than_mask(x, y);
            mask |= below << first;
            let (mut values, mut found) = ([T::ZERO; BLOCK], [0; BLOCK]);
            isa.pack(below | !I::ALL, x, &mut values);
            isa.pack_places(below | !I::ALL, &places[first..], &mut found);
            packed.extend(&values[..below.count_ones() as usize]);
            packed_places.extend(&found[..below.count_ones() as usize]);
            (y.where_above_zero(y)).add_to(&mut sums.as_mut()[part]);
        }
        columns.push(packed);
        columns.push(vec![I::total_of_parts(sums)]);
        // one pattern for whatever is not a number: its sign and payload are not the same everywhere
        let bits = columns.iter().flatten().map(|x| if x == x { x.to_f64().to_bits() } else { u64::MAX });
        let rest = packed_places.into_iter().chain([mask]).map(u64::from);
        bits.chain(rest).collect()
    }
}

fn check<T: Real>() {
    let expected = Job::<T>::run(Everything, Portable);
    for level in InstructionSet::available() {
        assert_eq!(T::dispatch(level, Everything), expected, "{} {level:?}", T::NAME);
    }
}

#[test]
fn every_instruction_set_gives_the_bits_of_plain_loops() {
    check::<f32>();
    check::<f64>();
}

#[test]
fn plain_loops_do_what_the_words_say() {
    let (a, b) = numbers::<f64>();
    let bits = Job::<f64>::run(Everything, Portable);
    let column = |number: usize| bits[number * BLOCK..][..BLOCK].iter().map(|&bits| f64::from_bits(bits));
    for (k, (min, max)) in column(6).zip(column(7)).enumerate().filter(|(k, _)| ![9, 12].contains(k)) {
        assert_eq!((min, max), (a[k].min(b[k]), a[k].max(b[k])), "{k}");
    }
    // where one is not a number, the second of the two
    assert_eq!((column(6).nth(9), column(7).nth(9)), (Some(9.0), Some(9.0)));
    assert!(column(9).all(|x| x.is_sign_positive()), "a positive part is never −0");
    assert_eq!(column(9).nth(9), Some(0.0));
    let kept: Vec<f64> = (0..BLOCK).map(|k| if b[k] > 0.0 { a[k] } else { 0.0 }).collect();
    assert!(column(11).zip(kept).all(|(found, kept)| found.to_bits() == kept.to_bits() || kept.is_nan()));
    for number in 0..4 {
        assert!(column(14 + number).enumerate().all(|(k, x)| x == (10 * k + number) as f64));
    }
    let below: Vec<usize> = (0..BLOCK).filter(|&k| a[k] < b[k]).collect();
    let rest = &bits[18 * BLOCK..];
    assert!(below.iter().zip(rest).all(|(&k, &bits)| a[k].to_bits() == bits));
    let rest = &rest[below.len()..];
    let columns: [f64; BLOCK] = std::array::from_fn(|k| if b[k] > 0.0 { b[k] } else { 0.0 });
    let halved = [8, 4, 2, 1]
        .iter()
        .fold(columns.to_vec(), |sums, &half| (0..half).map(|k| sums[k] + sums[k + half]).collect());
    assert_eq!(f64::from_bits(rest[0]), halved[0]);
    let places = below.iter().map(|&k| 100 + k as u64);
    assert!(places.eq(rest[1..rest.len() - 1].iter().copied()));
    assert_eq!(rest[rest.len() - 1], below.iter().map(|k| 1 << k).sum::<u64>());
}
