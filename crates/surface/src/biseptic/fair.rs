//! The fairest coefficients that meet linear conditions.

use super::Coefficients;
use super::spoke::binomial;

/// Norm under which what is left of a condition of norm 1 counts as implied by the others. Over all valences and modes
/// what is left is above 1e-3 or below 2e-13.
const IMPLIED: f64 = 1e-9;

/// A linear equation `weights . x = value`.
#[derive(Clone)]
struct Equation {
    weights: Vec<f64>,
    value: f64,
}

impl Equation {
    /// Subtracts the multiple of `unit`, an equation with weights of norm 1, that makes the weights orthogonal.
    fn reduce(&mut self, unit: &Self) {
        let share = dot(&self.weights, &unit.weights);
        subtract(&mut self.weights, share, &unit.weights);
        self.value -= share * unit.value;
    }

    fn reduced(mut self, units: &[Self]) -> Self {
        units.iter().for_each(|unit| self.reduce(unit));
        self
    }

    fn norm(&self) -> f64 {
        dot(&self.weights, &self.weights).sqrt()
    }

    fn without_value(self) -> Self {
        Self { value: 0.0, ..self }
    }

    fn normalized(mut self) -> Self {
        let norm = self.norm();
        self.weights.iter_mut().for_each(|w| *w /= norm);
        self.value /= norm;
        self
    }
}

/// The coefficients whose entries `free` minimise the sum of the squared fourth differences along i and j, given the
/// others and conditions `weights . b = value`, which must leave no bicubic free: the outer sides alone allow multiples
/// of one.
pub(super) fn fill(fixed: &Coefficients, free: &[usize], conditions: &[(Coefficients, f64)]) -> Coefficients {
    let restricted = |(weights, value): &(Coefficients, f64)| Equation {
        weights: free.iter().map(|&k| weights[k]).collect(),
        value: value - dot(weights, fixed),
    };
    let mut b = *fixed;
    let conditions = conditions.iter().map(restricted).collect();
    let energy = fourth_differences().iter().map(|weights| restricted(&(*weights, 0.0))).collect();
    for (&k, x) in free.iter().zip(minimise(conditions, energy, free.len())) {
        b[k] = x;
    }
    b
}

/// The 64 fourth differences of rows and columns of coefficients.
fn fourth_differences() -> Vec<Coefficients> {
    let difference = |from: usize, step: usize| {
        let mut weights = [0.0; 64];
        for m in 0..=4 {
            weights[from + m * step] = if m % 2 == 0 { binomial(4, m) } else { -binomial(4, m) };
        }
        weights
    };
    let lines = (0..8).flat_map(|line| (0..4).map(move |start| (line, start)));
    lines.flat_map(|(line, start)| [difference(start + 8 * line, 1), difference(line + 8 * start, 8)]).collect()
}

/// The x of `size` numbers that meets the conditions, which must not contradict each other, with the least sum of
/// squares of the `energy` equations' errors.
fn minimise(conditions: Vec<Equation>, energy: Vec<Equation>, size: usize) -> Vec<f64> {
    let met = orthonormal(conditions);
    // What the conditions leave open, as directions.
    let units = (0..size).map(|k| Equation { weights: (0..size).map(|i| f64::from(i == k)).collect(), value: 0.0 });
    let open = orthonormal(units.map(|unit| unit.reduced(&met).without_value()).collect());
    let energy: Vec<Equation> = energy.into_iter().map(|equation| equation.reduced(&met)).collect();
    let columns = open.iter().map(|d| energy.iter().map(|e| dot(&e.weights, &d.weights)).collect()).collect();
    let along = least_squares(columns, energy.iter().map(|e| e.value).collect());
    let mut x = vec![0.0; size];
    for (unit, amount) in met.iter().map(|m| (m, m.value)).chain(open.iter().zip(along)) {
        subtract(&mut x, -amount, &unit.weights);
    }
    x
}

/// Equations with orthonormal weights that say the same, by Gram-Schmidt with the largest remainder next and every
/// pivot orthogonalised twice (Golub and Van Loan, *Matrix Computations*, sections 5.2 and 5.4).
fn orthonormal(equations: Vec<Equation>) -> Vec<Equation> {
    let mut left: Vec<Equation> =
        equations.into_iter().filter(|e| e.norm() > IMPLIED).map(Equation::normalized).collect();
    let mut done: Vec<Equation> = Vec::new();
    while let Some((at, norm)) = largest(&left).filter(|&(_, norm)| norm > IMPLIED) {
        debug_assert!(norm <= 1.0 + 1e-9);
        let pivot = left.swap_remove(at).reduced(&done).normalized();
        left.iter_mut().for_each(|equation| equation.reduce(&pivot));
        done.push(pivot);
    }
    done
}

fn largest(equations: &[Equation]) -> Option<(usize, f64)> {
    equations.iter().map(Equation::norm).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The y that minimises `|sum y_k columns_k - right|`, by modified Gram-Schmidt on the columns with the right side
/// among them (Golub and Van Loan, section 5.3.5). The columns must be independent.
fn least_squares(mut columns: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let count = columns.len();
    let mut upper = vec![vec![0.0; count]; count];
    let mut y = vec![0.0; count];
    for k in 0..count {
        let (head, tail) = columns.split_at_mut(k + 1);
        let unit = &mut head[k];
        upper[k][k] = dot(unit, unit).sqrt();
        unit.iter_mut().for_each(|x| *x /= upper[k][k]);
        for (column, entry) in tail.iter_mut().zip(&mut upper[k][k + 1..]) {
            *entry = dot(unit, column);
            subtract(column, *entry, unit);
        }
        y[k] = dot(unit, &right);
        subtract(&mut right, y[k], unit);
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|m| upper[k][m] * y[m]).sum();
        y[k] = (y[k] - known) / upper[k][k];
    }
    y
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn subtract(a: &mut [f64], factor: f64, b: &[f64]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x -= factor * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn equation(weights: [f64; 3], value: f64) -> Equation {
        Equation { weights: weights.to_vec(), value }
    }

    #[test]
    fn minimum_meets_conditions_and_is_stationary() {
        // x + y + z = 3 twice, x - y = 1; least x^2 + (2 y - z)^2 + (y + z - 1)^2.
        let conditions = vec![
            equation([1.0, 1.0, 1.0], 3.0),
            equation([2.0, 2.0, 2.0], 6.0),
            equation([0.0, 0.0, 0.0], 0.0),
            equation([1.0, -1.0, 0.0], 1.0),
        ];
        let energy =
            vec![equation([1.0, 0.0, 0.0], 0.0), equation([0.0, 2.0, -1.0], 0.0), equation([0.0, 1.0, 1.0], 1.0)];
        let x = minimise(conditions, energy, 3);
        // On the line (1 + y, y, 2 - 2 y): (1+y)^2 + (4 y - 2)^2 + (1 - y)^2 is least at 18 y = 8.
        let y = 4.0 / 9.0;
        for (got, expected) in x.iter().zip([1.0 + y, y, 2.0 - 2.0 * y]) {
            assert!((got - expected).abs() < 1e-15, "{x:?}");
        }
    }

    #[test]
    fn cubics_are_fairest() {
        // A bicubic as coefficients of degree 7 is what its own border and one corner fill in.
        let cubic = |k: usize| {
            let (i, j) = ((k % 8) as f64, (k / 8) as f64);
            (i * i * i - 2.0 * i * i + 1.0) * (j * j - j * j * j / 5.0 + 3.0)
        };
        let free: Vec<usize> = (0..64).filter(|k| k % 8 <= 4 && k / 8 <= 4).collect();
        let expected: Coefficients = std::array::from_fn(cubic);
        let fixed: Coefficients = std::array::from_fn(|k| if free.contains(&k) { 0.0 } else { cubic(k) });
        let corner = (std::array::from_fn(|k| f64::from(k == 0)), cubic(0));
        let filled = fill(&fixed, &free, &[corner]);
        let worst = (0..64).map(|k| (filled[k] - expected[k]).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-9 * expected.iter().fold(0.0_f64, |m, x| m.max(x.abs())), "{worst:e}");
    }
}
