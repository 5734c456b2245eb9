"""Figures. Each function draws one on an Axes and returns it; none saves a file."""
