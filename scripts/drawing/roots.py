"""Roots of steady sliding in words."""

import xarray as xr


def roots_in_words(roots: xr.Dataset | None) -> str:
    """Whether steady sliding is stable, its unstable roots, and its rightmost root."""
    if roots is None:
        return "not declared"
    number = int(roots.attrs["unstable_roots"])
    words = f"{'unstable' if number else 'stable'} ({number} unstable root{'s' * (number != 1)}"
    if not roots.sizes["root"]:
        return f"{words}, all real parts below ${roots.attrs['root_bound']:g}$)"
    first = int(roots.root_real.values.argmax())
    real, imaginary = float(roots.root_real[first]), abs(float(roots.root_imag[first]))
    value = f"{real:.4g}" + (rf" \pm {imaginary:.4g}\,i" if imaginary else "")
    return rf"{words}, rightmost $\lambda = {value}$)"
