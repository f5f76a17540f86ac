"""The analysis room: figures and plots of a run, from its record alone."""

from preview_walk.analysis.plots import PLOTS, overview, plot, plot_all, save_plot
from preview_walk.analysis.summary import Summary, summarize

__all__ = ["PLOTS", "Summary", "overview", "plot", "plot_all", "save_plot", "summarize"]
