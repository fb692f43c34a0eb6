"""The comparison, the study, the benchmark and the paper's figures: pictures, charts and tables."""
