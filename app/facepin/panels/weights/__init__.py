"""The weights panel: the slider interface of the paper's Figure 3, live while the face is dragged."""

from facepin.panels.weights.panel import weights_panel
from facepin.panels.weights.view import WeightsView

__all__ = ["WeightsView", "weights_panel"]
