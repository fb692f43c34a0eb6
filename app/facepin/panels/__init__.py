"""imgui panels: functions of explicit arguments that return an Edit or a Request."""
