"""Roots of steady sliding in words."""

import xarray as xr


def roots_in_words(roots: xr.Dataset) -> str:
    """Whether steady sliding is stable, its unstable pairs, and its rightmost root."""
    pairs = int(roots.attrs["unstable_pairs"])
    # an odd number of real roots is in no pair
    alone = int(((roots.root_real > 0) & (roots.root_imag == 0)).sum()) % 2
    state = "unstable" if pairs or alone else "stable"
    words = f"{state} ({pairs} unstable pair{'' if pairs == 1 else 's'} of roots"
    words += " and a real one" * alone
    if not roots.sizes["root"]:
        return f"{words}, all real parts below ${roots.attrs['root_bound']:g}$)"
    first = int(roots.root_real.values.argmax())
    real, imaginary = float(roots.root_real[first]), abs(float(roots.root_imag[first]))
    value = f"{real:.4g}" + (rf" \pm {imaginary:.4g}\,i" if imaginary else "")
    return rf"{words}, rightmost $\lambda = {value}$)"
