"""The weights panel: the slider interface of the paper's Figure 3, live while the face is dragged."""
