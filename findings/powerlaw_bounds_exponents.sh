#!/usr/bin/env bash
# powerlaw 2.0.0 bounds the exponent of a fit to 3, where 1.5 did not.
#
# Expected: of sizes with the exact quantiles of a power law, the estimate of maximum likelihood,
# 1 + n/sum(log(size)), from both versions.
# Seen: below an exponent of 3 it is. Above it 2.0.0 returns 3 to rounding, with verbose=0 without a
# message; 1.5 returns the estimate, and so does 2.0.0 with a parameter_ranges of one's own. The only sign
# is the attribute noise_flag.
# Matters: a search for the least size compares fits, so that it takes another one, too.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/fit.py" <<'END'
import sys
import warnings

warnings.simplefilter("ignore")
import numpy as np
import powerlaw

rank = (np.arange(2000) + 0.5) / 2000
for exponent in (2.5, 3.5, 5.0):
    sizes = (1 - rank) ** (-1 / (exponent - 1))
    estimate = 1 + len(sizes) / np.log(sizes).sum()
    fits = [powerlaw.Fit(sizes, xmin=1.0, verbose=0)]
    expected = [min(estimate, 3.0) if sys.argv[1] == "2.0.0" else estimate]
    if sys.argv[1] == "2.0.0":
        ranges = {"alpha": [1.01, 20.0]}
        fits.append(powerlaw.Fit(sizes, xmin=1.0, verbose=0, parameter_ranges=ranges))
        expected.append(estimate)
    found = [fit.power_law.alpha for fit in fits]
    print(sys.argv[1], f"estimate {estimate:.4f}", *(f"fit {one:.4f}" for one in found))
    if not np.allclose(found, expected, rtol=1e-4):
        sys.exit(f"expected {expected}")
END
for version in 1.5 2.0.0; do
    python3 -m venv "$folder/$version"
    "$folder/$version/bin/pip" install -q "powerlaw==$version" "numpy==2.2.6" "scipy==1.15.3"
    "$folder/$version/bin/python" "$folder/fit.py" "$version"
done
