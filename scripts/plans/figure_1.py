"""Figure 1: block and spring between loader plate and rough surface (a drawing, no data)."""
