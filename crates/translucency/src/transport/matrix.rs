//! Small dense matrices: products and quotients of a few dozen rows.

/// A square matrix, row after row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    size: usize,
    data: Vec<f64>,
}

impl Matrix {
    /// All entries by their row and column.
    #[inline(always)]
    pub fn from_fn(size: usize, entry: impl Fn(usize, usize) -> f64) -> Matrix {
        Matrix { size, data: (0..size * size).map(|at| entry(at / size, at % size)).collect() }
    }

    /// Entries on the diagonal, zero elsewhere.
    pub fn diagonal(entries: &[f64]) -> Matrix {
        Matrix::from_fn(entries.len(), |row, column| if row == column { entries[row] } else { 0.0 })
    }

    /// Entry of a row and a column.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.data[row * self.size + column]
    }

    /// One row.
    #[inline(always)]
    pub fn row(&self, row: usize) -> &[f64] {
        &self.data[row * self.size..(row + 1) * self.size]
    }

    /// This times `other`.
    #[inline(always)]
    pub fn times(&self, other: &Matrix) -> Matrix {
        let n = self.size;
        let mut data = vec![0.0; n * n];
        for (row, sums) in data.chunks_exact_mut(n).enumerate() {
            for (k, factor) in self.row(row).iter().enumerate() {
                sums.iter_mut().zip(other.row(k)).for_each(|(sum, value)| *sum += factor * value);
            }
        }
        Matrix { size: n, data }
    }

    /// This plus `other`.
    #[inline(always)]
    pub fn plus(&self, other: &Matrix) -> Matrix {
        Matrix { size: self.size, data: self.data.iter().zip(&other.data).map(|(a, b)| a + b).collect() }
    }

    /// One less this.
    #[inline(always)]
    pub fn one_less(&self) -> Matrix {
        Matrix::from_fn(self.size, |row, column| f64::from(u8::from(row == column)) - self.at(row, column))
    }

    /// One plus this.
    pub fn and_one(&self) -> Matrix {
        Matrix::from_fn(self.size, |row, column| f64::from(u8::from(row == column)) + self.at(row, column))
    }

    #[inline(always)]
    fn transposed(&self) -> Matrix {
        Matrix::from_fn(self.size, |row, column| self.at(column, row))
    }

    /// This times the inverse of `divisor`.
    #[inline(always)]
    pub fn over(&self, divisor: &Matrix) -> Matrix {
        divisor.transposed().under(&self.transposed()).transposed()
    }

    /// The inverse of this times `right`: Gauss with row exchange.
    #[inline(always)]
    pub fn under(&self, right: &Matrix) -> Matrix {
        let n = self.size;
        let (mut left, mut right) = (self.clone(), right.clone());
        for pivot in 0..n {
            let largest = |a: &usize, b: &usize| left.at(*a, pivot).abs().total_cmp(&left.at(*b, pivot).abs());
            let best = (pivot..n).max_by(largest).unwrap_or(pivot);
            left.exchange(pivot, best);
            right.exchange(pivot, best);
            for row in pivot + 1..n {
                let factor = left.at(row, pivot) / left.at(pivot, pivot);
                left.subtract(row, pivot, factor, pivot);
                right.subtract(row, pivot, factor, 0);
            }
        }
        for pivot in (0..n).rev() {
            let scale = 1.0 / left.at(pivot, pivot);
            right.data[pivot * n..(pivot + 1) * n].iter_mut().for_each(|value| *value *= scale);
            for row in 0..pivot {
                right.subtract(row, pivot, left.at(row, pivot), 0);
            }
        }
        right
    }

    #[inline(always)]
    fn exchange(&mut self, a: usize, b: usize) {
        if a != b {
            (0..self.size).for_each(|column| self.data.swap(a * self.size + column, b * self.size + column));
        }
    }

    /// Row `to` less `factor` times row `from`, from a column on; `from` differs from `to`.
    #[inline(always)]
    fn subtract(&mut self, to: usize, from: usize, factor: f64, first: usize) {
        let n = self.size;
        let (low, high) = self.data.split_at_mut(to.max(from) * n);
        let (target, source) = if to > from {
            (&mut high[..n], &low[from * n..(from + 1) * n])
        } else {
            (&mut low[to * n..(to + 1) * n], &high[..n])
        };
        target[first..].iter_mut().zip(&source[first..]).for_each(|(a, b)| *a -= factor * b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_undo_products() {
        let hash = |row: usize, column: usize| {
            f64::from(((row * row * 37 + column.pow(3) * 101 + row * column * 53 + 11) % 97) as u32) / 97.0
        };
        let (a, b) = (Matrix::from_fn(7, hash), Matrix::from_fn(7, |i, j| hash(j + 3, i)));
        let close = |x: &Matrix, y: &Matrix| x.data.iter().zip(&y.data).all(|(p, q)| (p - q).abs() < 1e-11);
        assert!(close(&a.times(&b).over(&b), &a));
        assert!(close(&a.under(&a.times(&b)), &b));
        // A zero on the diagonal needs the exchange.
        let swap = Matrix::from_fn(2, |i, j| f64::from(u8::from(i != j)));
        assert_eq!(swap.under(&swap), Matrix::diagonal(&[1.0, 1.0]));
    }
}
