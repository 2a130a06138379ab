# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the product uses all that it defines: what tests alone use belongs to Testing/Support, what
benchmarks alone use to Testing/Benchmarks."""

import unittest

import symbols

# Why a name may stand where it is defined and nowhere else.
REASONS = {
    "__launch_bounds__": "an attribute of CUDA",
    "parallelism": "what it limits is limited while it lives",
    "PeakBytes": "benchmarks of a GPU: nothing outside the device counts what it frees",
    "ThreadLimit": "tests and benchmarks: oneTBB, which threads belong to, is cuda/backend's alone",
}


class TestSymbols(unittest.TestCase):
    def test_all_are_used_by_the_product(self):
        found = [symbol for symbol in symbols.unused() if symbol.name not in REASONS]
        self.assertFalse(found, "\n".join(
            ["The product does not use these. Delete them, or move them to what does use them."] +
            [f"{path}: {name}: {', '.join(folders) or 'used nowhere'}"
             for name, path, folders in found]))

    def test_reasons_are_needed(self):
        found = {symbol.name for symbol in symbols.unused()}
        self.assertLessEqual(REASONS.keys(), found)

    def test_what_is_only_declared_is_told_from_what_is_used(self):
        declared, used = symbols.read("""
            #define LIMPID_TWICE(x) Doubled(x)
            namespace limpid {
            class Unused;
            template <class T> class Field { // Commented(1)
             public:
              int Size() const { return Count(this->values); }
              static Field Of(const Grid& grid, double scale = Scale());
              double factor = 2;
             private:
              std::vector<T> values;
            };
            using Fields = std::vector<Field<int>>;
            double Free(double x) { return x * Helper(x); }
            template void Swept<Field<int>>(Field<int>&);
            void Field::Undo() {}
            friend class Tester;
            class Lonely { public: explicit Lonely(int); ~Lonely(); struct Part; };
            struct Lonely::Part { Lonely* whole; };
            Lonely::Lonely(int) {}
            Lonely::~Lonely() = default;
            }
        """)
        self.assertLessEqual({"Unused", "Field", "Size", "Of", "factor", "values", "Fields", "Free",
                              "Undo", "Lonely"}, declared)
        self.assertLessEqual({"Doubled", "Count", "values", "Scale", "Helper", "Field", "Grid"}, used)
        for name in ("Unused", "Size", "Free", "factor", "Undo", "Tester", "Lonely", "Commented"):
            self.assertNotIn(name, used)


if __name__ == "__main__":
    unittest.main()
