"""The units of sizes. Apart from the other modules: jobs need no more, and pydantic takes long."""

# [m]
UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "inch": 0.0254}
